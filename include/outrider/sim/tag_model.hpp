// A model of what a camera sees of tags, without an image: a thousand times faster than rendering one.
//
// A tag is in view when its face is towards the camera, its four corners are within the image, it appears at
// least `least_px` wide, and nothing of the ground at the camera's height stands between them. Its corners
// get normal errors, and its poses come from planar_pnp() as those of a real image do. Some tags are missed.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag.hpp"
#include "outrider/sim/drive_sim_params.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Whether the tag is in view of a camera at that pose.
bool in_view(const Tag& tag, const Camera& camera, const Pose3& world_T_camera, const CollisionMap& ground);

/// What a robot with that camera sees from a pose. The faults tell nothing of time here.
std::vector<TagSighting> modelled_sightings(const TagMap& tags, const RobotCamera& camera,
                                            const TagSightFaults& faults, const CollisionMap& ground,
                                            const Pose2& world_T_robot, Rng& rng);

}  // namespace outrider
