// StopCheck: decides whether a robot that stands at a stop has reached it.
//
// The belief alone cannot tell: it is wrong if somebody has moved the robot. So a stop is reached only if
//   1. the robot has stood for `settle_s` without an image that contradicts the belief,
//   2. since then the tags of at least `settle_sightings` images, taken at rest, were accepted, the last of
//      them just now,
//   3. the newest of these images alone, and the mean of the last few, agree with the belief,
//   4. the tags in the newest image are where they were in the images before, to within the noise of their
//      corners: a push that is too small to contradict the belief still moves them,
//   5. the standard deviation of the belief is at most `settle_sigma`.
// An image that contradicts the belief, or in which the tags have moved, starts the count anew. If all errors
// are as the options say, the robot is off the stop by at most tolerance_m() and tolerance_rad(): what the
// follower leaves, and four standard deviations. O(1) an image.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>

#include "outrider/estimate/belief.hpp"
#include "outrider/estimate/tag.hpp"

namespace outrider {

struct DriveTask;
struct DriveRules;

/// Mean position of the corners of a tag in the image.
struct MeanCorners {
  std::array<Vec2, 4> px;
  std::int64_t images = 0;
};

/// The observations since the robot stands at a stop.
struct StopCheck {
  double since_s = 0.0;                ///< since when the robot stands there
  double counts_from_s = 0.0;          ///< since_s, or the last image that contradicted the belief
  std::int64_t accepted = 0;           ///< images since then whose tags were accepted
  std::int64_t refused = 0;            ///< images since `since_s` that contradict the belief
  std::deque<PoseBelief> poses;        ///< of the last of these images, without the belief
  std::map<int, MeanCorners> corners;  ///< by id of the tag, while the robot is at rest
  bool is_still = false;               ///< the newest image shows the tags where they were before

  /// Starts the count at a time.
  static StopCheck at(double time_s) { return {time_s, time_s, 0, 0, {}, {}, false}; }
  /// Notes the pose that an accepted image gives.
  void accept(const PoseBelief& pose);
  /// Compares the corners of tags with those in earlier images. The robot is at rest.
  void compare(std::span<const TagSighting> sightings, double corner_sigma_px, double time_s);
  /// Notes an image that contradicts the belief.
  void refuse(double time_s);

  /// Starts the count anew at a time.
  void restart(double time_s);

  /// Returns why the stop is not reached with this belief; empty if it is. Condition 1 is the caller's.
  [[nodiscard]] std::string doubt(const PoseBelief& belief, const DriveRules& rules) const;
};

/// Returns by how much the position may be off at a stop that is reached, m.
double tolerance_m(const DriveTask& task);
/// Returns the same for the heading, rad.
double tolerance_rad(const DriveTask& task);

}  // namespace outrider
