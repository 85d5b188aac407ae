#include "turning_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "turning_order.hpp"

namespace outrider::cover {
namespace {

constexpr double measured_step_rad = radians(2.0);
constexpr double same_part = 1e-3;  // of the reach: so much more is not left out

/// Numbers of laps to try: with the first, half a turn fits beside a lane.
std::vector<int> headlands(const CoverProblem& problem, TurningMethod method) {
  if (method == TurningMethod::laps) return {all_laps};
  std::vector<int> laps;
  if (problem.headland > 0) laps.push_back(static_cast<int>(problem.headland));
  for (const double radii : {1.0, 1.5, 2.0, 3.0}) {
    const int count =
        std::max(1, static_cast<int>(std::ceil(radii * problem.turning_radius_m / problem.stride_m())));
    if (problem.headland == 0 && (laps.empty() || laps.back() != count)) laps.push_back(count);
  }
  if (method == TurningMethod::both) laps.push_back(all_laps);
  return laps;
}

double missed_m2(const CoverPlan& plan, const CoverProblem& problem, const CoverageArea& ground,
                 const std::stop_token& stop) {
  const auto points = points_along(plan.track.start.position, plan.track.pieces, measured_step_rad);
  return coverage_of(points, problem.sure_radius_m(), ground.reach, stop).missed_m2;
}

tl::unexpected<Fault> fits_nowhere(const CoverProblem& problem) {
  return bad_input(
      fmt::format("no lap and no lane fits a robot {:g} m wide whose curves have a radius of {:g} m or "
                  "more; give a smaller radius",
                  problem.width_m, problem.turning_radius_m),
      "turning_radius");
}

}  // namespace

Outcome<CoverPlan> turning_plan(const CoverProblem& problem, const CoverOptions& options,
                                const Budget& budget, TurningMethod method) {
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  const CoverField& field = ground->fields.front();
  const FreeRoom room(*field.ground);
  std::optional<CoverPlan> best;
  double best_missed_m2 = 0.0;
  std::optional<Fault> refused;
  for (const int laps : headlands(problem, method)) {
    auto strokes =
        turning_strokes(problem, field, ground->arc_m, options.directions, laps, room, budget.stop);
    if (!strokes) return pass_on(strokes);
    if (strokes->empty()) continue;
    auto plan = ordered_strokes(*strokes, problem, options, room, budget);
    if (!plan && plan.error().code == FaultCode::start_blocked) refused = plan.error();
    if (!plan && !refused) return plan;
    if (!plan) continue;
    plan->sums = sums_of(plan->track.start.heading_rad, plan->track.pieces, problem.pace);
    const double missed = missed_m2(*plan, problem, *ground, budget.stop);
    const double more = same_part * area_of(ground->reach);
    const bool better = !best || missed < best_missed_m2 - more ||
                        (missed <= best_missed_m2 + more && plan->sums.time_s < best->sums.time_s);
    if (!better) continue;
    best = std::move(*plan);
    best->method = laps == all_laps ? "spiral" : "boustrophedon";
    best_missed_m2 = missed;
  }
  if (!best && refused) return tl::unexpected<Fault>(*refused);
  if (!best) return fits_nowhere(problem);
  best->ground = std::move(*ground);
  return std::move(*best);
}

}  // namespace outrider::cover
