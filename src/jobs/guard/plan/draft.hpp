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

/// Returns the targets that have a firing region, ascending.
std::vector<std::size_t> targets_with_region(const FiringMap& firing_map);

}  // namespace outrider
