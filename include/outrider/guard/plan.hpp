// The plan of a guard mission: where to stop, in which order, and what to shoot from there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/guard/site.hpp"
#include "outrider/path/routes.hpp"

namespace outrider {

struct PlannedHit {
  std::size_t target = 0;
  PlannedShot shot;
};

struct PlannedStop {
  Vec2 position;
  std::vector<Vec2> waypoints;  ///< from the stop before, both included
  std::vector<PlannedHit> hits;
};

struct Unreachable {
  std::size_t target = 0;
  std::string reason;  ///< one sentence, with the resolution at which it is proven
};

struct GuardPlan {
  std::vector<PlannedStop> stops;
  std::vector<Unreachable> unreachable;
  std::optional<Routes> routes;  ///< between the start and the stops; nothing when there are none
  double cost_s = 0.0;           ///< mission time if nothing goes wrong
  double lower_bound_s = 0.0;    ///< no plan that hits from cells of the regions takes less (bound.hpp)
  bool tour_proven = false;      ///< no better tour of the stops last looked at exists
  std::size_t places = 0;        ///< cells that can be driven to

  /// The part of the cost that the bound leaves open: at most this much of it could be saved.
  [[nodiscard]] double gap() const { return cost_s > 0.0 ? 1.0 - lower_bound_s / cost_s : 0.0; }
};

/// Plans the mission over all places of the site: picks a few hundred of them that matter, solves the
/// tour, looks closer around the best one, and makes sure of each shot. Every target of the problem is
/// in exactly one stop or in `unreachable`. Deterministic. The lower bound is bound.hpp's.
Outcome<GuardPlan> plan_guard(const GuardProblem& problem, const Site& site, const GuardOptions& options,
                              const Budget& budget);

/// Routes between places of the site. Where the corners of the obstacles lose a passage that the grid
/// has, cells of a grid path join in: places that see a reachable cell next to them are all connected.
Outcome<Routes> site_routes(const GuardProblem& problem, const Site& site, const std::vector<Vec2>& stops,
                            const Budget& budget);

}  // namespace outrider
