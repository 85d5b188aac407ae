// A model of tag detection without images. It is about a thousand times faster than rendering.
//
// A tag is in view if it faces the camera, its four corners are inside the image, it appears at least
// `least_px` wide, and no obstacle at the height of the camera stands between them. Its corners get normal
// errors, and its poses are computed by planar_pnp(), as for a real image. Some tags are missed at random.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag.hpp"
#include "outrider/sim/faults/drive_sim_params.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Returns true if the tag is in view of a camera at that pose.
bool in_view(const Tag& tag, const Camera& camera, const Pose3& world_T_camera, const CollisionMap& ground);

/// Returns the sightings of a robot with that camera at a pose. `faults.blind_from_s` is not used here.
std::vector<TagSighting> modelled_sightings(const TagMap& tags, const RobotCamera& camera,
                                            const TagSightFaults& faults, const CollisionMap& ground,
                                            const Pose2& world_T_robot, Rng& rng);

}  // namespace outrider
