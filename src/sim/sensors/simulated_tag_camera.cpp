#include "outrider/sim/sensors/simulated_tag_camera.hpp"

#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/sim/sensors/tag_model.hpp"
#include "times.hpp"

namespace outrider {
namespace {

constexpr double band_m = 0.01;  ///< of heights about the camera, in which sight lines are sought

}  // namespace

CollisionMap sight_lines(const World& world, double height_m) {
  std::vector<RoundedPolygon> obstacles;
  const double z_m = world.floor_z_m + height_m;
  for (const Solid& solid : world.solids) {
    for (RoundedPolygon& piece : footprint(solid, z_m - band_m, z_m + band_m)) {
      obstacles.push_back(std::move(piece));
    }
  }
  constexpr double beyond_m = 10.0;  // tags hang on walls, which may stand on the edge
  return {world.bounds.grown(beyond_m), std::move(obstacles)};
}

SimulatedTagCamera::SimulatedTagCamera(const TagScene& scene, const RobotCamera& camera,
                                       const TagCameraOptions& options, const TagSightFaults& faults,
                                       bool rendered, const Rng& rng)
    : tags_(scene.tags),
      camera_(camera),
      options_(options),
      faults_(faults),
      sight_lines_(sight_lines(scene.world, camera.robot_T_camera.position.z)),
      rendering_(rendered ? std::make_unique<TagCamera>(scene, camera, options, rng.child("camera"))
                          : nullptr),
      sight_rng_(rng.child("sight")) {}

void SimulatedTagCamera::change_tags(double at_s, TagMap tags) {
  changes_s_ = at_s;
  changed_ = std::move(tags);
}

const std::optional<TagImage>& SimulatedTagCamera::newest(double time_s) {
  while (!arriving_.empty() && arriving_.front().taken_s + options_.latency_s <= time_s + instant_s) {
    newest_ = std::move(arriving_.front());
    arriving_.pop_front();
  }
  return newest_;
}

void SimulatedTagCamera::take(const Pose2& world_T_robot, const Twist2& twist, double time_s) {
  ++images_;
  if (time_s >= changes_s_) {
    changes_s_ = std::numeric_limits<double>::infinity();
    tags_ = changed_;
    if (rendering_) rendering_->set_tags(changed_);
  }
  TagImage& image = arriving_.emplace_back(TagImage{time_s, {}});
  if (time_s >= faults_.blind_from_s) return;
  image.sightings =
      rendering_ ? rendering_->look(moved(world_T_robot, twist, -options_.exposure_s), world_T_robot)
                 : modelled_sightings(tags_, camera_, faults_, sight_lines_, world_T_robot, sight_rng_);
  for (TagSighting& sighting : image.sightings) {
    const Tag* expected = expected_.find(sighting.id);
    const Tag* tag = tags_.find(sighting.id);
    if (expected != nullptr && tag != nullptr && expected->size_m != tag->size_m)
      sighting.poses = planar_pnp(camera_.camera, expected->size_m, sighting.corners_px);
  }
}

}  // namespace outrider
