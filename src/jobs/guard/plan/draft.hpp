// Drafts: the best tours over some cells of a firing_map, with the shots that make them up.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider {

/// The exact shot by (cell, target); nothing where no shot keeps the margin. Filled as needed.
using ShotBook = std::map<std::pair<std::size_t, std::size_t>, std::optional<PlannedShot>>;

/// A tour over cells. Its goals are the targets that have a firing region and in it, decided exactly, a shot
/// from some cell.
struct Draft {
  std::vector<std::size_t> cells;    ///< by stop of the tour; entry 0 stands for the start
  std::vector<std::size_t> targets;  ///< by goal of the tour
  StopTable offered;                 ///< the stops, shots and drives that the tour was chosen from
  Tour tour;
};

/// The task of a draft.
struct DraftTask {
  std::vector<std::size_t> targets;  ///< to hit, ascending; each needs a firing region
  std::int64_t exact_goals =
      TourOptions{}.exact_goals;  ///< up to so many, each tour is the best of its stops
};

/// The best tour found by looking at a error_ratio of stops first, then closer around the stops of the best
/// tour, again and again until that no longer helps. Over the stops looked at last the tour then gets its
/// bound, and is improved once more where that finds a better one. `book` holds the shot of each hit.
Outcome<Draft> draft_tour(const GuardProblem& problem, const FiringMap& firing_map, const DraftTask& task,
                          const GuardOptions& options, const Budget& budget, ShotBook& book,
                          const DraftObserver& observe = {});

/// Gives each hit of the draft's tour, in its order, the shot of those found at its stop with which the tour
/// ends soonest. They replace those of the same stops and targets in `offered` and in `book`; the tour gets
/// its new cost and loses its bound. No shot becomes less sure. O(hits x pitches) searches for a shot.
void choose_shots(const GuardProblem& problem, const FiringMap& firing_map, const GuardOptions& options,
                  ShotBook& book, Draft& draft);

/// Plans like plan_guard(), but hits only `targets`, each of which needs a firing region. Others are neither
/// in a stop nor in `unreachable`. There are no lower bounds. The start of the problem may be any place that
/// is connected with the start for which the firing map was built.
Outcome<GuardPlan> plan_part(const GuardProblem& problem, const FiringMap& firing_map,
                             const std::vector<std::size_t>& targets, const GuardOptions& options,
                             const Budget& budget);

}  // namespace outrider
