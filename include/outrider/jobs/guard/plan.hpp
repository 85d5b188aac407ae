// The plan of a guard mission: where to stop, in which order, and what to shoot from there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/jobs/guard/passing.hpp"
#include "outrider/path/routes/routes.hpp"

namespace outrider {

struct PlannedHit {
  std::size_t target = 0;
  PlannedShot shot;
};

struct PlannedStop {
  Vec2 position;
  std::vector<Vec2> waypoints;  ///< from the stop before, both included
  std::vector<PlannedHit> hits;
  std::optional<StationCall> call = {};  ///< a store is filled here, and nothing is shot at
  std::vector<PassingHit> passing = {};  ///< shots on the way to here (passing_plan.hpp)
};

struct Unreachable {
  std::size_t target = 0;
  std::string reason;  ///< one sentence, with the resolution at which it is proven
};

struct GuardPlan {
  std::vector<PlannedStop> stops;
  std::vector<Unreachable> unreachable;
  std::vector<Unreachable> unsupplied = {};  ///< those that the supplies do not suffice for (supply_plan.hpp)
  std::optional<Routes> routes;              ///< between the start and the stops; nothing when there are none
  double cost_s = 0.0;                       ///< mission time if nothing goes wrong
  /// The same as the tour solver counts it, each flight as often as it is expected to be flown; nothing for
  /// plans that are not its tour.
  std::optional<double> expected_s = {};
  /// No tour of the stops, shots and drives last offered takes less, counted so (solve.hpp); where the robot
  /// may shoot in passing, no mission at all (passing_plan.hpp).
  double lower_bound_s = 0.0;
  double anywhere_lower_bound_s = 0.0;  ///< no plan that hits from cells of the regions does (bound.hpp)
  bool tour_proven = false;             ///< no better tour of the stops last offered exists
  std::size_t stops_offered = 0;        ///< to the tour solver in the end
  std::size_t places = 0;               ///< cells that can be driven to

  /// The time that `lower_bound_s` bounds.
  [[nodiscard]] double bounded_s() const { return expected_s.value_or(cost_s); }
  /// The parts of the time that the bounds leave open: at most so much of it could be saved.
  [[nodiscard]] double gap() const { return left_open(lower_bound_s, bounded_s()); }
  [[nodiscard]] double anywhere_gap() const { return left_open(anywhere_lower_bound_s, cost_s); }

  static double left_open(double bound_s, double time_s) {
    return time_s > 0.0 ? 1.0 - bound_s / time_s : 0.0;
  }
};

/// Plans the mission over all places of the firing_map: picks a few hundred of them that matter, solves the
/// tour, looks closer around the best one, and makes sure of each shot. Every target of the problem is
/// in exactly one stop or in `unreachable`. Deterministic. The tour counts expected flights, the cost each
/// flight once, so the plan is mostly a little faster than its tour.
Outcome<GuardPlan> plan_guard(const GuardProblem& problem, const FiringMap& firing_map,
                              const GuardOptions& options, const Budget& budget);

/// Routes between places of the firing_map. Where the corners of the obstacles lose a passage that the grid
/// has, cells of a grid path join in: places that see a reachable cell next to them are all connected.
Outcome<Routes> yard_routes(const GuardProblem& problem, const FiringMap& firing_map,
                            const std::vector<Vec2>& stops, const Budget& budget);

}  // namespace outrider
