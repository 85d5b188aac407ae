#include "outrider/sim/sensors/tag_model.hpp"

#include <algorithm>

namespace outrider {
namespace {

constexpr double least_px = 12.0;       ///< width of a tag that can be decoded
constexpr double before_wall_m = 0.01;  ///< where the line of sight ends, before the wall that bears the tag
constexpr double least_cosine = 0.17;   ///< of the angle between the tag's axis and the line of sight

Pose3 upright(const Pose2& pose) {
  return {{pose.position.x, pose.position.y, 0.0}, Rotation::from_rpy(0.0, 0.0, pose.heading_rad)};
}

std::optional<std::array<Vec2, 4>> corners_in_image(const Tag& tag, const Camera& camera,
                                                    const Pose3& world_T_camera) {
  std::array<Vec2, 4> corners;
  const std::array<Vec3, 4> local = tag_corners(tag.size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto point = project(camera, world_T_camera.to_local(tag.world_T_tag * local[i]));
    if (!point || point->x < 0.0 || point->x > camera.width_px || point->y < 0.0 ||
        point->y > camera.height_px) {
      return std::nullopt;
    }
    corners[i] = *point;
  }
  return corners;
}

}  // namespace

bool in_view(const Tag& tag, const Camera& camera, const Pose3& world_T_camera, const CollisionMap& ground) {
  const Vec3 sight = world_T_camera.position - tag.world_T_tag.position;
  const Vec3 out = -1.0 * tag.world_T_tag.rotation.axes[2];
  if (dot(sight, out) < least_cosine * norm(sight)) return false;
  const auto corners = corners_in_image(tag, camera, world_T_camera);
  if (!corners) return false;
  if (std::min(distance((*corners)[0], (*corners)[1]), distance((*corners)[1], (*corners)[2])) < least_px) {
    return false;
  }
  const Vec2 wall = xy(tag.world_T_tag.position + before_wall_m * out);
  return ground.segment_free({xy(world_T_camera.position), wall}, 0.0);
}

std::vector<TagSighting> modelled_sightings(const TagMap& tags, const RobotCamera& camera,
                                            const TagSightFaults& faults, const CollisionMap& ground,
                                            const Pose2& world_T_robot, Rng& rng) {
  std::vector<TagSighting> sightings;
  const Pose3 world_T_camera = upright(world_T_robot) * camera.robot_T_camera;
  for (const Tag& tag : tags.tags) {
    if (!in_view(tag, camera.camera, world_T_camera, ground)) continue;
    if (rng.uniform() < faults.missed) continue;
    TagSighting sighting;
    sighting.id = tag.id;
    sighting.corners_px = *corners_in_image(tag, camera.camera, world_T_camera);
    for (Vec2& corner : sighting.corners_px) {
      corner = corner + faults.corner_sigma_px * Vec2{rng.normal(), rng.normal()};
    }
    sighting.poses = planar_pnp(camera.camera, tag.size_m, sighting.corners_px);
    if (!sighting.poses.empty()) sightings.push_back(std::move(sighting));
  }
  return sightings;
}

}  // namespace outrider
