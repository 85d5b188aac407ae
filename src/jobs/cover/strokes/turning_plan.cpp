#include "strokes/turning_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"
#include "strokes/turning_order.hpp"

namespace outrider::cover {
namespace {

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
  return coverage_along(plan.track.start, plan.track.pieces, problem, ground.reach, true, stop).missed_m2;
}

struct Candidate {
  int laps = 0;
  std::vector<Stroke> strokes;
  double missed_m2 = 0.0;
  double time_s = 0.0;
};

/// Returns true if the candidate leaves less, by more than `more_m2`, or takes less time.
bool better(const Candidate& one, const Candidate& than, double more_m2) {
  if (std::abs(one.missed_m2 - than.missed_m2) > more_m2) return one.missed_m2 < than.missed_m2;
  return one.time_s < than.time_s;
}

tl::unexpected<Fault> fits_nowhere(const CoverProblem& problem) {
  return bad_input(
      fmt::format("a robot {:g} m wide whose curves have a radius of {:g} m or more finds no lap and no "
                  "lane from which it could drive on; give a smaller radius",
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
  TourOptions hasty = options.order;  // proves nothing yet
  hasty.gap = 1.0;
  std::optional<Candidate> best;
  std::optional<Fault> refused;
  for (const int laps : headlands(problem, method)) {
    auto strokes =
        turning_strokes(problem, field, ground->arc_m, options.directions, laps, room, budget.stop);
    if (!strokes) return pass_on(strokes);
    if (strokes->empty()) continue;
    const auto plan = ordered_strokes(*strokes, problem, hasty, room, budget);
    if (!plan && plan.error().code != FaultCode::start_blocked) return plan;
    if (!plan) {
      refused = plan.error();
      continue;
    }
    const double time_s = sums_of(plan->track.start.heading_rad, plan->track.pieces, problem.pace).time_s;
    Candidate one{laps, std::move(*strokes), missed_m2(*plan, problem, *ground, budget.stop), time_s};
    if (!best || better(one, *best, same_part * area_of(ground->reach))) best = std::move(one);
  }
  if (!best && refused) return tl::unexpected<Fault>(*refused);
  if (!best) return fits_nowhere(problem);
  auto plan = ordered_strokes(best->strokes, problem, options.order, room, budget);
  if (!plan) return plan;
  plan->method = best->laps == all_laps ? "spiral" : "boustrophedon";
  plan->sums = sums_of(plan->track.start.heading_rad, plan->track.pieces, problem.pace);
  plan->ground = std::move(*ground);
  return plan;
}

}  // namespace outrider::cover
