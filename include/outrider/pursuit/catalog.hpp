// The catalogue of pursuit planners: the rows of src/pursuit/catalog.cpp, and those that a program adds.
#pragma once

#include <functional>
#include <memory>
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

/// Returns a row's `configure` for a planner with options of this type, which have a describe().
template <class Options>
std::function<ConfiguredPursuitPlanner()> with_pursuit_options(
    Outcome<PursuitPlan> (*planner)(const PursuitProblem&, const Options&, const Budget&, Workspace&)) {
  return [planner] {
    const auto options = std::make_shared<Options>();
    return ConfiguredPursuitPlanner{
        describe(*options),
        [planner, options](const PursuitProblem& problem, const Budget& budget, Workspace& workspace) {
          return planner(problem, *options, budget, workspace);
        }};
  };
}

/// Returns all planners in display order; the first is the default.
const std::vector<PursuitPlanner>& pursuit_planners();

/// Adds a row at the end, for all who read the catalogue later. Before the first thread starts.
void add_pursuit_planner(PursuitPlanner row);

/// Returns the planner of that name. Fault: bad_input, with the nearest known name.
Outcome<PursuitPlanner> find_pursuit_planner(std::string_view name);

}  // namespace outrider
