// Photos as grey images: PNG, JPEG and PGM (P2, P5), detected by their first bytes.
//
// Files may be gzip-compressed.
// The grey value is the mean of the colours of a PNG, and the luminance of a JPEG (ITU-R BT.601).
// Faults: bad_input with the file. Bounds: sides up to 100,000 and 100 million pixels.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/camera_image.hpp"

namespace outrider {

Outcome<CameraImage> load_photo(const std::string& path);

/// Reads a photo from the content of a file. `name` is for faults.
Outcome<CameraImage> photo_from_bytes(std::string_view bytes, const std::string& name);

/// Returns the image as a grey PNG file.
std::string to_png(const CameraImage& image);

}  // namespace outrider
