// Calibration files of cameras: YAML as ROS and OpenCV write it, or with a bare matrix.
//
// Reads keys camera_matrix (a map with `data`, nine numbers by rows) or K (nine numbers), and where they are
// given distortion_coefficients (a map with `data`) or D (four or five numbers: k1 k2 p1 p2 k3),
// distortion_model (plumb_bob), image_width and image_height, or width and height. The keys may stand one
// level down, in named sections: then the name of one is asked for.
// Errors: bad_input with file, line and key: a singular matrix, skew, anything but a pinhole, a lens model
// that is not known. Bounds: 1 MiB.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/camera.hpp"

namespace outrider {

/// Width and height are 0 where the file does not tell; whoever has an image fills them in.
Outcome<Camera> camera_from_text(std::string_view text, const std::string& name,
                                 const std::string& section = {});

Outcome<Camera> load_camera(const std::string& path, const std::string& section = {});

}  // namespace outrider
