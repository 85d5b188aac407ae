// Planners of fleets, and their catalogue.
//
// All take the problem of fleet.hpp. Faults: bad_input for a problem without a grid, a grid of the model
// `corners`, no robots or too many, unequal numbers of starts and goals, two robots with one start or one
// goal; outside_map, start_blocked and goal_blocked, with the number of the robot, from 1; no_path (proven)
// if a robot cannot reach its goal on the empty grid; budget_exhausted; cancelled. Same input, same plan.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/fleet/fleet.hpp"

namespace outrider {

/// Options of prioritized().
struct PrioritizedOptions {
  std::int64_t attempts = 100;  ///< orders of the robots that are tried
};
std::vector<Option> describe(PrioritizedOptions& options);

/// Plans one robot after another, each round the paths of those before it. The robot with the longest way
/// comes first; a robot that finds no path comes first in the next attempt. Fast and often good; not optimal,
/// and not complete: if no order was found, the fault is budget_exhausted. lower_bound is the sum of the
/// lengths on the empty grid. An expansion is a cell at a step. Source: Erdmann and Lozano-Perez, On multiple
/// moving objects (1987); Silver, Cooperative pathfinding (2005).
Outcome<FleetPlan> prioritized(const FleetProblem& problem, const PrioritizedOptions& options,
                               const Budget& budget);

/// Options of cbs().
struct CbsOptions {
  std::int64_t most_nodes = 1'000'000;  ///< nodes of the constraint tree, about 200 bytes and one path each
};
std::vector<Option> describe(CbsOptions& options);

/// Conflict-based search: plans each robot alone, takes a collision, and branches into two problems, in each
/// of which one of the two robots must avoid it. Of the earliest collisions it takes one that costs more
/// either way, if there is one. If a robot can avoid a collision for nothing and then collides with fewer
/// others, it does so without a branch. Optimal: the least sum of costs, which is
/// lower_bound. Finds a plan whenever there is one and the budget allows it; where there is none it never
/// ends by itself, but by `most_nodes` or the budget. Exponential in the number of collisions. An expansion
/// is a cell at a step in the search of one robot. Source: Sharon, Stern, Felner and Sturtevant,
/// Conflict-based search for optimal multi-agent pathfinding (2015); Boyarski et al., ICBS: improved
/// conflict-based search algorithm for multi-agent pathfinding (2015). Among equal costs the node with fewer
/// collisions comes first.
Outcome<FleetPlan> cbs(const FleetProblem& problem, const CbsOptions& options, const Budget& budget);

/// Options of lacam().
struct LacamOptions {
  std::int64_t most_configurations = 1'000'000;  ///< sets of cells of all robots that are kept
};
std::vector<Option> describe(LacamOptions& options);

/// Lazy constraints addition search: a depth-first search over the cells of all robots at once, in which each
/// step is made by priority inheritance with backtracking (PIBT) under constraints that are added one by one.
/// Complete: no_path is proven, since in the end every step from every reached configuration was tried. Fast
/// with hundreds of robots; not optimal. lower_bound is the sum of the lengths on the empty grid. An
/// expansion is a step of all robots. Sources: Okumura, LaCAM: search-based algorithm for quick multi-agent
/// pathfinding (2023); Okumura, Machida, Defago and Tamura, Priority inheritance with backtracking (2022).
Outcome<FleetPlan> lacam(const FleetProblem& problem, const LacamOptions& options, const Budget& budget);

/// A planner with its own set of options.
struct ConfiguredFleetPlanner {
  std::vector<Option> options;  ///< set them at any time; `plan` reads them at each call
  std::function<Outcome<FleetPlan>(const FleetProblem&, const Budget&)> plan;
};

/// A planner in the catalogue.
struct FleetPlanner {
  std::string_view name;
  std::string_view sentence;                          ///< one sentence that says what the planner does
  std::string_view paper;                             ///< source of the algorithm
  bool complete = false;                              ///< finds a plan, or proves that there is none
  bool optimal = false;                               ///< its plans have the least sum of costs
  std::string_view guarantee;                         ///< the guarantee in words
  std::function<ConfiguredFleetPlanner()> configure;  ///< makes a planner with default options
};

/// Returns all planners of fleets, in the order of display.
const std::vector<FleetPlanner>& fleet_planners();

/// Returns the planner of that name. Fault: bad_input, with the nearest known name.
Outcome<FleetPlanner> find_fleet_planner(std::string_view name);

}  // namespace outrider
