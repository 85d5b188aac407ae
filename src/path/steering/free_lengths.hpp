// FreeLengths: the lengths of shortest turning paths to the goal in an empty plane, from a table that is
// filled as it is asked.
//
// The table is in the frame of the goal, in radii, so it holds for every goal and every radius, and stays in
// the workspace. Its cells are an eighth of a radius wide and its headings 5 degrees apart, out to five
// radii; farther away the straight distance stands for the length. An answer is that of the middle of the
// cell, so it may be too large by a part of the radius: it guides a search and proves nothing.
#pragma once

#include <array>
#include <vector>

#include "outrider/geometry/pose.hpp"

namespace outrider {

class FreeLengths {
 public:
  /// Returns the length from a pose in the frame of the goal, in radii, forwards only or with reversing.
  double at(const Pose2& goal_T_pose, bool reverse);

 private:
  std::array<std::vector<float>, 2> tables_;  ///< without and with reversing; negative where not yet known
};

}  // namespace outrider
