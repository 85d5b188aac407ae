#include "outrider/path/steering/steering_options.hpp"

#include <optional>

namespace outrider {

std::vector<Option> describe(SteeringOptions& options) {
  return {
      {"turning_radius", "m", 1e-3, 1e4, "least radius on which the robot turns", &options.turning_radius_m},
      {"reverse", "", 0, 0, "the robot can drive backwards", &options.reverse},
      {"cusp", "m", 0.0, 1e4, "price of a change between forwards and backwards, as a length",
       &options.cusp_price_m},
      {"backward", "", 1.0, 1e3, "price of a metre backwards, in metres forwards", &options.backward_price},
      {"start_heading", "", 0, 0, "heading at the start in degrees, if the start has none; empty: any",
       &options.start_heading},
      {"goal_heading", "", 0, 0, "heading at the goal in degrees, if the goal has none; empty: any",
       &options.goal_heading}};
}

Status check(const SteeringOptions& options) {
  SteeringOptions copy = options;
  return check_ranges(describe(copy));
}

Outcome<Problem> with_headings(Problem problem, const SteeringOptions& options) {
  const auto set = [](const std::string& text, const char* name,
                      std::optional<double>& heading_rad) -> Status {
    if (text.empty() || heading_rad) return {};
    double angle_rad = 0.0;
    const Option option{name, "deg", -3600.0, 3600.0, "", &angle_rad};
    if (auto ok = assign(option, text); !ok) return ok;
    heading_rad = angle_rad;
    return {};
  };
  if (auto ok = set(options.start_heading, "start_heading", problem.start_heading_rad); !ok)
    return pass_on(ok);
  if (auto ok = set(options.goal_heading, "goal_heading", problem.goal_heading_rad); !ok) return pass_on(ok);
  return problem;
}

Steering steering_of(const SteeringOptions& options) { return {options.turning_radius_m, options.reverse}; }

CostWeights weights_of(const SteeringOptions& options) {
  CostWeights weights;
  weights.per_cusp = options.cusp_price_m;
  weights.per_backward_m = options.backward_price - 1.0;
  return weights;
}

}  // namespace outrider
