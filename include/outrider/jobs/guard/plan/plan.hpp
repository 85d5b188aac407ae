// GuardPlan: where the robot stops, in which order, and which targets it shoots at from each stop.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/plan/passing.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/path/routes/routes.hpp"

namespace outrider {

/// A planned shot at a target.
struct PlannedHit {
  std::size_t target = 0;
  PlannedShot shot;
};

/// Returns true if the robot waits until the ball of a shot from rest has landed (GuardPlan::on_the_move).
inline bool is_awaited(const PlannedShot& shot, bool on_the_move) { return !on_the_move || !shot.survives; }

/// A stop of the plan.
struct PlannedStop {
  Vec2 position;
  std::vector<Vec2> waypoints;           ///< path from the previous stop to here, both included
  std::vector<PlannedHit> hits;          ///< shots from here, in order
  std::optional<StationCall> call = {};  ///< set if a store is filled here; then there are no shots
  std::vector<PassingHit> passing = {};  ///< shots during the drive to here (shoot_in_passing())

  /// Adds the targets that are hit during the drive to here, then those that are hit from here.
  void add_targets(std::vector<std::size_t>& targets) const {
    for (const PassingHit& hit : passing) targets.push_back(hit.target);
    for (const PlannedHit& hit : hits) targets.push_back(hit.target);
  }
};

/// A target that the plan leaves out.
struct Unreachable {
  std::size_t target = 0;
  std::string reason;  ///< one sentence, with the resolution at which it is proven
};

/// The plan of a mission, with its cost and proven bounds.
struct GuardPlan {
  std::vector<PlannedStop> stops;        ///< in order
  std::vector<Unreachable> unreachable;  ///< targets that cannot be hit
  std::vector<Unreachable> unsupplied =
      {};                        ///< targets for which the supplies do not suffice (supply_plan.hpp)
  std::optional<Routes> routes;  ///< between the start and the stops; unset without stops
  double cost_s = 0.0;           ///< mission time if every shot hits
  /// Mission time with expected repetitions of missed shots, as the tour solver counts it. Unset for plans
  /// that the tour solver did not make.
  std::optional<double> expected_s = {};
  /// Proven lower bound on `bounded_s()` for tours over the stops, shots and drives last given to the solver
  /// (solve.hpp). If the robot may shoot in passing, the bound holds for every mission (shoot_in_passing()).
  double lower_bound_s = 0.0;
  double anywhere_lower_bound_s =
      0.0;  ///< bound for plans that hit from any cells of the regions (bound.hpp)
  /// The gun turns to the next shot during drives, and nobody waits for a ball that hits for sure
  /// (PlannedShot::survives). Otherwise the gun rests during drives, and each ball lands before the next
  /// move.
  bool on_the_move = false;
  bool tour_proven = false;       ///< the tour is optimal for the stops last given to the solver
  std::size_t stops_offered = 0;  ///< number of stops last given to the tour solver
  std::size_t places = 0;         ///< number of reachable cells

  /// Returns the targets in the order in which they are hit.
  [[nodiscard]] std::vector<std::size_t> targets() const {
    std::vector<std::size_t> all;
    for (const PlannedStop& stop : stops) stop.add_targets(all);
    return all;
  }
  /// Returns the time that `lower_bound_s` bounds.
  [[nodiscard]] double bounded_s() const { return expected_s.value_or(cost_s); }
  /// Return the optimality gaps: the largest fraction of the time that a better plan could save.
  [[nodiscard]] double gap() const { return left_open(lower_bound_s, bounded_s()); }
  [[nodiscard]] double anywhere_gap() const { return left_open(anywhere_lower_bound_s, cost_s); }

  static double left_open(double bound_s, double time_s) {
    return time_s > 0.0 ? 1.0 - bound_s / time_s : 0.0;
  }
};

/// A stop of a tour, with the targets that are shot at from there.
struct DraftStop {
  Vec2 position;
  std::vector<std::size_t> targets;
};

/// A tour that planning has found so far.
struct TourDraft {
  std::vector<DraftStop> stops;  ///< in order
  std::vector<Vec2> way;         ///< from the start through all stops
  double cost_s = 0.0;           ///< as the tour solver counts it
  double lower_bound_s = 0.0;    ///< proven so far, over the stops that are looked at; 0: nothing yet
};

/// Receives tours while they are planned, on the thread that plans. It changes nothing in the plan.
using DraftObserver = std::function<void(const TourDraft&)>;

/// Returns the tour of a plan.
TourDraft draft_of(const GuardProblem& problem, const GuardPlan& plan);

/// Plans the mission. It selects a few hundred stops from the cells of the firing map, solves the tour,
/// refines the selection near the best tour, and verifies each shot. Every target is in exactly one stop or
/// in `unreachable`. Deterministic. `expected_s` includes repeated shots while `cost_s` counts each flight
/// once, so `cost_s` is usually a little less. `observe` receives tours that are faster by 1 % or more than
/// the one before.
Outcome<GuardPlan> plan_guard(const GuardProblem& problem, const FiringMap& firing_map,
                              const GuardOptions& options, const Budget& budget,
                              const DraftObserver& observe = {});

/// Returns the fastest way between two places on `routes`, or where no corner is seen from them, along the
/// grid; empty if there is none. Fault: budget_exhausted.
Outcome<std::vector<Vec2>> yard_way(const GuardProblem& problem, const FiringMap& firing_map,
                                    const std::optional<Routes>& routes, const Pose2& from, Vec2 to,
                                    const Budget& budget = {});

/// Returns routes between stops. The search uses the corners of obstacles; if these miss a passage that the
/// grid has, cells of a grid path are added. All stops that see a reachable cell next to them are connected.
Outcome<Routes> yard_routes(const GuardProblem& problem, const FiringMap& firing_map,
                            const std::vector<Vec2>& stops, const Budget& budget);

/// Improves a plan: lets the gun turn during drives, waits for no ball that hits for sure, and moves shots
/// from stops to drives (passing.hpp), one shot or all shots of a stop at a time, as long as that makes the
/// mission shorter. Then it moves stops, to anywhere on free ground, where that shortens the drives, and
/// begins again. A stop without shots is removed, and the path past it is planned again. The result is never
/// longer than `plan`. Both lower bounds become 0, because those of a tour hold only for shots from rest;
/// mission_bound() has one for missions on the move. Stops at stations stay where they are, each tankful
/// serves the same targets as before, and the supplies suffice (supply_plan.hpp). A stop request ends the
/// search for shorter plans. A round tries O(hits + stops) changes, each with O(stops) drives and the shots
/// along those that are new.
GuardPlan shoot_in_passing(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                           const std::stop_token& stop = {});

}  // namespace outrider
