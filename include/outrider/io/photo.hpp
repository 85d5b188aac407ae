// Photos as grey images: PNG, JPEG and PGM (P2, P5), told by their first bytes; any may be gzip-compressed.
//
// Colours of a PNG count by their mean, those of a JPEG by how bright the eye finds them (ITU-R BT.601).
// Errors: bad_input with the file. Bounds: sides up to 100,000 and 100 million pixels.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/camera_image.hpp"

namespace outrider {

Outcome<CameraImage> load_photo(const std::string& path);

/// `name` is for faults.
Outcome<CameraImage> photo_from_bytes(std::string_view bytes, const std::string& name);

/// The image as a grey PNG.
std::string to_png(const CameraImage& image);

}  // namespace outrider
