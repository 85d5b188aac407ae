// The catalogue of guard planners: the rows of src/jobs/guard/catalog.cpp, and those that a program adds.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// A guard planner. Every planner gives the guarantees of plan_guard(), except those about the quality of the
/// tour: each target is in exactly one stop or in `unreachable`, each shot hits with the margin, each leg is
/// free, the cost is the sum of its parts, and the same input gives the same plan.
struct GuardPlanner {
  std::string_view name;
  std::string_view sentence;  ///< one sentence that says what the planner does
  std::string_view source;    ///< source of the method
  Outcome<GuardPlan> (*method)(const GuardProblem&, const FiringMap&, const GuardOptions&, const Budget&,
                               const DraftObserver&) = nullptr;
  std::string_view guarantee =  ///< in words
      "each target is in one stop or no shot at it was found at the resolution, each shot hits with the "
      "margin, each leg is free; no bound of its time";

  /// Plans by the method. `observe` receives tours while they are planned, from methods that search for one.
  [[nodiscard]] Outcome<GuardPlan> plan(const GuardProblem& problem, const FiringMap& firing_map,
                                        const GuardOptions& options, const Budget& budget,
                                        const DraftObserver& observe = {}) const {
    return method(problem, firing_map, options, budget, observe);
  }
};

/// Returns all guard planners, in the order of display; the first is the default.
const std::vector<GuardPlanner>& guard_planners();

/// Adds a row at the end, for all who read the catalogue later. Before the first thread starts.
void add_guard_planner(const GuardPlanner& row);

/// Returns the planner of that name. Fault: bad_input, with the nearest known name.
Outcome<GuardPlanner> find_guard_planner(std::string_view name);

}  // namespace outrider
