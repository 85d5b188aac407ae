// DriveSimParams: faults of the wheels, the radio link and the camera of a simulated robot, what is wrong
// with its tags, and a kidnapping.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/planner_outage.hpp"
#include "outrider/estimate/tag.hpp"
#include "outrider/motion/wheel_faults.hpp"
#include "outrider/sim/faults/clock_faults.hpp"
#include "outrider/sim/faults/kidnapping.hpp"

namespace outrider {

/// Faults of a tag camera.
struct TagSightFaults {
  double corner_sigma_px = 0.2;  ///< standard deviation of a detected corner; used without rendered images
  double missed = 0.02;          ///< fraction of visible tags not detected; used without rendered images
  double blind_from_s = 1e9;     ///< time at which the camera fails; it sees nothing afterwards
};

/// A tag that hangs elsewhere than the map says, from the start or from some time on.
struct MovedTag {
  std::int64_t id = -1;  ///< of the tag; -1: none
  double by_m = 0.3;     ///< to the right of a reader of the tag
  double at_s = 0.0;     ///< time at which it is moved
};

/// The faults that occur while a simulated robot drives.
struct DriveSimParams {
  WheelFaults wheels;          ///< errors between commanded and true wheel speeds
  LinkFaults link;             ///< faults of the link that carries the commands
  double patience_s = 0.5;     ///< without a command after which the wheels are told to stop
  TagSightFaults sight;        ///< faults of the camera
  Kidnapping kidnapping;       ///< none by default
  ClockFaults clock;           ///< none by default
  PlannerOutage planner;       ///< none by default; a drive is planned at 0 s
  MovedTag moved_tag;          ///< none by default
  double tag_scale = 1.0;      ///< true size of every tag, relative to what the robot is told
  std::optional<TagMap> tags;  ///< where the tags truly hang; none: where the map of the robot says
};
/// Returns the true tags at the start, and from moved_tag.at_s on, for a robot with that map.
TagMap true_tags(const TagMap& map, const DriveSimParams& params);
TagMap true_tags_later(const TagMap& map, const DriveSimParams& params);

/// Returns the options of all members except the link, the patience and the tags.
std::vector<Option> describe(DriveSimParams& params);

}  // namespace outrider
