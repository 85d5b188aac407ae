// TagCamera: a simulated camera. It renders images of tags and detects the tags in them.
//
// Only the boxes of pixels around tags that may be visible are rendered; the rest of the image is grey. A
// pixel is the mean of samples along the rays of the lens, spread over the area of the pixel and over the
// exposure time. So the perspective is exact, edges are smooth, and moving objects are blurred. Box-shaped
// solids hide tags with their exact shape, other solids with their bounding box; half-spaces and height
// fields hide nothing. Noise with standard deviation `noise_grey` is added; its first four moments are those
// of a normal distribution.
//
// Thread rule: one camera per thread. The same seed and poses give the same images, bit for bit.
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
  double rate_hz = 10.0;       ///< images per second; used by SimulatedTagCamera
  double exposure_s = 0.01;    ///< exposure time
  double latency_s = 0.0;      ///< from an exposure until its tags are known; used by SimulatedTagCamera
  double noise_grey = 3.0;     ///< standard deviation of the noise of a pixel, on a scale of 0 to 255
  double black_grey = 30.0;    ///< grey value of the ink
  double white_grey = 220.0;   ///< grey value of the paper
  std::int64_t samples = 4;    ///< samples per side of a pixel, 1 to 8: samples^2 per pixel
  double least_tag_px = 12.0;  ///< tags that appear smaller are not rendered
};

std::vector<Option> describe(TagCameraOptions& options);

/// The world and the tags that the camera sees.
struct TagScene {
  World world;
  TagMap tags;
};

/// A rendered image. Outside the boxes it has one grey value.
struct RenderedImage {
  CameraImage image;
  std::vector<PixelBox> boxes;  ///< rendered parts; they do not overlap
};

/// Returns boxes of pixels around the tags that may be visible while the camera moves between the two poses.
std::vector<PixelBox> tag_boxes(const Camera& camera, const TagScene& scene, const Pose3& world_T_opening,
                                const Pose3& world_T_closing, const TagCameraOptions& options = {});

/// Renders the given boxes; pass one box of the size of the image to render all of it. The camera moves from
/// the pose at which the shutter opens to the pose at which it closes. O(pixels * solids in view).
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

  /// Replaces the tags in the world.
  void set_tags(TagMap tags) { scene_.tags = std::move(tags); }

  /// Returns the last image.
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
