// The catalogue of guard planners; src/guard/catalog.cpp is the only list.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// Every planner keeps the promises of plan_guard() but for the tour itself: each target is in exactly one
/// stop or in `unreachable`, each shot hits with the margin, each leg is free, the cost is what its parts add
/// up to, and the same input gives the same plan.
struct GuardPlanner {
  std::string_view name;
  std::string_view sentence;
  std::string_view source;
  Outcome<GuardPlan> (*plan)(const GuardProblem&, const FiringMap&, const GuardOptions&,
                             const Budget&) = nullptr;
};

/// All of them, in the order of showing; the first is the default.
const std::vector<GuardPlanner>& guard_planners();

/// Fault: bad_input with the nearest known name.
Outcome<GuardPlanner> find_guard_planner(std::string_view name);

}  // namespace outrider
