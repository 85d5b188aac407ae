// SteeringOptions: a robot that steers and cannot turn in place, as the planners of such robots see it.
//
// The origin of the robot moves along arcs of at least `turning_radius_m` and straight pieces, for a car the
// middle of its rear axle. The robot is the outline of the problem, exactly, or a disk.
#pragma once

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
  std::string start_heading;      ///< degrees, where the problem has none; empty: any
  std::string goal_heading;       ///< as `start_heading`
};
std::vector<Option> describe(SteeringOptions& options);
/// Checks the ranges. Fault: bad_input with the name of the option.
Status check(const SteeringOptions& options);

/// Returns the problem with the headings of the options where it has none. Fault: bad_input for a text that
/// is no number.
Outcome<Problem> with_headings(Problem problem, const SteeringOptions& options);

/// Returns the limits.
Steering steering_of(const SteeringOptions& options);
/// Returns the weights of the cost: length, cusps, and metres backwards.
CostWeights weights_of(const SteeringOptions& options);

}  // namespace outrider
