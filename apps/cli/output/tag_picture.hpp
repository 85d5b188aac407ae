// Picture of a photo with the tags that were found in it.
#pragma once

#include <string>
#include <vector>

#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/camera_image.hpp"
#include "outrider/estimate/tag.hpp"

namespace outrider::cli {

/// Returns an SVG with the image inside. It shows outlines, ids, the lower left corner as a dot, and for each
/// pose the axis that points out of the tag, half as long as its side. The axis of a second solution is
/// dashed.
std::string tag_picture(const CameraImage& image, const Camera& camera, double size_m,
                        const std::vector<TagSighting>& sightings);

}  // namespace outrider::cli
