// SimulatedTagCamera: a camera on a robot that takes images at its own rate and reports the tags in them.
//
// Either the images are rendered and the tags detected in them (tag_camera.hpp), or the sightings come from a
// faster model without images (tag_model.hpp).
#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <optional>

#include "outrider/robot/observation.hpp"
#include "outrider/sim/faults/drive_sim_params.hpp"
#include "outrider/sim/sensors/tag_camera.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Returns the parts of the world at the height of a camera, as obstacles to sight. Tags hang on walls, which
/// may stand on the edge, so the map reaches 10 m beyond the bounds of the world.
CollisionMap sight_lines(const World& world, double height_m);

class SimulatedTagCamera {
 public:
  /// `rendered` selects rendered images. Draws from the child streams `camera` and `sight` of `rng`.
  SimulatedTagCamera(const TagScene& scene, const RobotCamera& camera, const TagCameraOptions& options,
                     const TagSightFaults& faults, bool rendered, const Rng& rng);

  /// Returns the time at which the next image is due.
  [[nodiscard]] double due_s() const { return static_cast<double>(images_ + 1) / options_.rate_hz; }
  /// Takes the next image. The robot is at that pose at `time_s` and moves with that twist.
  void take(const Pose2& world_T_robot, const Twist2& twist, double time_s);

  /// Hangs the tags elsewhere at a time.
  void change_tags(double at_s, TagMap tags);
  /// Says which sizes the robot expects of the tags; those are what their poses are computed with.
  void expect_sizes(const TagMap& map) { expected_ = map; }

  /// Returns the newest image whose tags are known at a time.
  const std::optional<TagImage>& newest(double time_s);
  [[nodiscard]] std::int64_t images() const { return images_; }  ///< taken so far
  /// Returns the last image; null if images are not rendered.
  [[nodiscard]] const RenderedImage* rendered() const { return rendering_ ? &rendering_->image() : nullptr; }

 private:
  TagMap tags_;
  RobotCamera camera_;
  TagCameraOptions options_;
  TagSightFaults faults_;
  CollisionMap sight_lines_;              // obstacles at the height of the camera
  std::unique_ptr<TagCamera> rendering_;  // null if images are not rendered
  Rng sight_rng_;
  std::int64_t images_ = 0;
  std::deque<TagImage> arriving_;  // images whose tags are not known yet
  std::optional<TagImage> newest_;
  double changes_s_ = std::numeric_limits<double>::infinity();
  TagMap changed_;   // the tags from then on
  TagMap expected_;  // tags with the sizes that the robot expects
};

}  // namespace outrider
