// The catalogue of pursuit planners; src/pursuit/catalog.cpp is the only list.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The guarantees of a planner with its default options.
struct PursuitGuarantee {
  bool complete = true;       ///< finds a catch whenever there is one, or proves that there is none
  bool optimal = true;        ///< the catch is the cheapest, with lower_bound = cost
  std::string_view sentence;  ///< the guarantee in words
};

/// A planner with an instance of its options, which `plan` reads at each call.
struct ConfiguredPursuitPlanner {
  std::vector<Option> options;  ///< options by name
  std::function<Outcome<PursuitPlan>(const PursuitProblem&, const Budget&, Workspace&)> plan;
};

/// A planner in the catalogue.
struct PursuitPlanner {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  PursuitGuarantee guarantee;
  std::function<ConfiguredPursuitPlanner()> configure;
};

/// Returns all planners in display order.
const std::vector<PursuitPlanner>& pursuit_planners();

/// Returns the planner of that name. Fault: bad_input, with the nearest known name.
Outcome<PursuitPlanner> find_pursuit_planner(std::string_view name);

}  // namespace outrider
