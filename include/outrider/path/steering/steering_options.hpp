// SteeringOptions: a robot that steers and cannot turn in place, as the planners of such robots see it.
//
// The planned point moves along arcs of at least `turning_radius_m` and straight pieces, for a car the middle
// of its rear axle. The robot is one disk around that point, whose radius the ground was grown by, or several
// such disks in a row along its axis: `disks` of them, evenly from `rear_m` behind the point to `front_m`
// ahead of it, besides that of the point itself. A rectangle of length l and width w is covered by n disks of
// radius sqrt((l / 2 n)^2 + (w / 2)^2) whose centres are l / n apart, the outer ones l / 2 n from its ends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// Options that all planners of robots that steer share. The headings are for callers that give points only.
struct SteeringOptions {
  double turning_radius_m = 0.5;  ///< least radius of an arc
  bool reverse = true;            ///< the robot can drive backwards
  double cusp_price_m = 0.5;      ///< price of a change of direction, as a length
  double backward_price = 1.0;    ///< price of a metre driven backwards, in metres forwards; at least 1
  double front_m = 0.0;           ///< distance of the first disk ahead of the planned point
  double rear_m = 0.0;            ///< distance of the last disk behind it
  std::int64_t disks = 3;         ///< number of disks from the last to the first
  std::string start_heading;      ///< degrees, where the problem has none; empty: any
  std::string goal_heading;       ///< as `start_heading`
};
std::vector<Option> describe(SteeringOptions& options);
/// Checks the ranges. Fault: bad_input with the name of the option.
Status check(const SteeringOptions& options);

/// Returns the problem with the headings of the options where it has none. Fault: bad_input for a text that
/// is no number.
Outcome<Problem> with_headings(Problem problem, const SteeringOptions& options);

/// Returns the limits and the disks.
Steering steering_of(const SteeringOptions& options);
/// Returns the weights of the cost: length, cusps, and metres backwards.
CostWeights weights_of(const SteeringOptions& options);

}  // namespace outrider
