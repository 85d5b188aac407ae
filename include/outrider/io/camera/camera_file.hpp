// Calibration files of cameras: YAML as written by ROS and OpenCV, or with a plain matrix.
//
// Required key: camera_matrix (a map with `data`, nine numbers by rows) or K (nine numbers). Optional keys:
// distortion_coefficients (a map with `data`) or D (four or five numbers: k1 k2 p1 p2 k3), distortion_model
// (plumb_bob), and image_width and image_height, or width and height. The keys may be in named sections, one
// level down; `section` then names the section to read.
// Faults: bad_input with file, line and key, for a singular matrix, skew, a camera that is not a pinhole, and
// an unknown lens model. Bounds: 1 MiB.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/camera.hpp"

namespace outrider {

/// Reads a camera. Width and height are 0 if the file does not state them; take them from an image then.
Outcome<Camera> camera_from_text(std::string_view text, const std::string& name,
                                 const std::string& section = {});

Outcome<Camera> load_camera(const std::string& path, const std::string& section = {});

}  // namespace outrider
