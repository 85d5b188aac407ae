#include "outrider/path/visibility/least_time.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tangent_search.hpp"

namespace outrider {
namespace {

constexpr double slowest_mps = 1e-3;
constexpr double fastest_mps = 1e3;
constexpr double most_price = 1e6;

Outcome<CostWeights> weights_of(const LeastTimeOptions& options) {
  const double speed = options.speed_mps, price = options.turn_price_s_per_rad;
  const bool good_speed = speed >= slowest_mps && speed <= fastest_mps;
  if (!good_speed) {
    return bad_input(fmt::format("{} m/s is not valid; expected {} to {}", speed, slowest_mps, fastest_mps),
                     "speed");
  }
  const bool good_price = price >= 0.0 && price <= most_price;
  if (!good_price) {
    return bad_input(fmt::format("{} s/rad is not valid; expected 0 to {:g}", price, most_price),
                     "turn_price");
  }
  if (!std::isfinite(options.heading_rad)) {
    return bad_input(fmt::format("{} is not valid; expected a finite angle", options.heading_rad), "heading");
  }
  CostWeights weights{1.0 / speed, price, std::nullopt};
  if (options.first_turn) weights.heading_rad = options.heading_rad;
  return weights;
}

VisibilityOptions straight(const LeastTimeOptions& options) { return {true, options.arc_step_rad}; }

}  // namespace

std::vector<Option> describe(LeastTimeOptions& options) {
  return {
      {"speed", "m/s", slowest_mps, fastest_mps, "speed on straight legs", &options.speed_mps},
      {"turn_price", "s/rad", 0.0, most_price, "time that turning in place takes",
       &options.turn_price_s_per_rad},
      {"first_turn", "", 0.0, 0.0, "counts the turn from `heading` to the first leg", &options.first_turn},
      {"heading", "deg", -180.0, 180.0, "heading at the start, for `first_turn`", &options.heading_rad},
      {"arc_step", "deg", 1.0, 90.0, "largest turn between the straight legs that stand for an arc",
       &options.arc_step_rad}};
}

Outcome<Plan> least_time(const Problem& problem, const LeastTimeOptions& options, const Budget& budget,
                         Workspace& workspace) {
  auto weights = weights_of(options);
  if (!weights) return pass_on(weights);
  return tangent_search(problem, *weights, straight(options), TangentForm::paired, budget, workspace);
}

std::vector<Outcome<Plan>> least_time_many(const Problem& problem, const std::vector<Vec2>& goals,
                                           const LeastTimeOptions& options, const Budget& budget,
                                           Workspace& workspace) {
  auto weights = weights_of(options);
  if (!weights) return std::vector<Outcome<Plan>>(goals.size(), pass_on(weights));
  return tangent_search_many(problem, goals, *weights, straight(options), TangentForm::paired, budget,
                             workspace);
}

}  // namespace outrider
