// TagCamera: the camera of a simulated robot, whose images are rendered and whose tags are detected in them.
//
// Only boxes of pixels around tags that may be visible are rendered; the rest of the image stays grey. In
// them each pixel is the mean of samples spread over its area and over the exposure, along the rays of the
// lens: perspective is exact, edges are smooth, and what moves is blurred. Boxes of the world hide tags with
// their exact shape, other solids with their bounding box; half-spaces and height fields hide nothing.
// Then comes noise: normal to four moments, standard deviation `noise_grey`.
//
// Thread rule: one camera per thread. The same seed and poses give the same images, to the byte.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/camera_image.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag.hpp"
#include "outrider/estimate/tag_detector.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

struct TagCameraOptions {
  double rate_hz = 10.0;       ///< images per second, for whoever asks when the next one is due
  double exposure_s = 0.01;    ///< for which the shutter is open
  double noise_grey = 3.0;     ///< standard deviation of a pixel, of 255
  double black_grey = 30.0;    ///< ink
  double white_grey = 220.0;   ///< paper
  std::int64_t samples = 4;    ///< across a pixel and down it: samples^2 in all, 1 to 8
  double least_tag_px = 12.0;  ///< tags that appear smaller are not rendered
};

std::vector<Option> describe(TagCameraOptions& options);

/// What is in front of the camera.
struct TagScene {
  World world;
  TagMap tags;
};

/// A rendered image. Outside the boxes it is of one grey.
struct RenderedImage {
  CameraImage image;
  std::vector<PixelBox> boxes;  ///< which were rendered; they do not overlap
};

/// The boxes around tags that may be visible from these poses.
std::vector<PixelBox> tag_boxes(const Camera& camera, const TagScene& scene, const Pose3& world_T_opening,
                                const Pose3& world_T_closing, const TagCameraOptions& options = {});

/// Renders these boxes, or all of the image for a box as large. The camera moves from where the shutter
/// opens to where it closes. Linear in pixels times solids in view.
RenderedImage render_tags(const Camera& camera, const TagScene& scene, const Pose3& world_T_opening,
                          const Pose3& world_T_closing, const std::vector<PixelBox>& boxes,
                          const TagCameraOptions& options, Rng noise);

class TagCamera {
 public:
  TagCamera(TagScene scene, const RobotCamera& robot_camera, const TagCameraOptions& options, const Rng& rng,
            const TagDetectorOptions& detector = {.refine_edges = true}, const PlanarPnpOptions& pnp = {});

  /// Takes an image while the robot moves from one pose to the other, and returns the tags detected in it,
  /// with their poses.
  std::vector<TagSighting> look(const Pose2& opening, const Pose2& closing);

  /// The image last taken.
  [[nodiscard]] const RenderedImage& image() const { return image_; }

 private:
  TagScene scene_;
  RobotCamera robot_camera_;
  TagCameraOptions options_;
  PlanarPnpOptions pnp_;
  TagDetector detector_;
  Rng rng_;
  std::uint64_t taken_ = 0;
  RenderedImage image_;
};

}  // namespace outrider
