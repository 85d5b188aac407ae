#include <memory>

#include "outrider/path/fleet/planners.hpp"

namespace outrider {
namespace {

template <class Options>
std::function<ConfiguredFleetPlanner()> with_options(Outcome<FleetPlan> (*planner)(const FleetProblem&,
                                                                                   const Options&,
                                                                                   const Budget&)) {
  return [planner] {
    const auto options = std::make_shared<Options>();
    return ConfiguredFleetPlanner{describe(*options),
                                  [planner, options](const FleetProblem& problem, const Budget& budget) {
                                    return planner(problem, *options, budget);
                                  }};
  };
}

}  // namespace

const std::vector<FleetPlanner>& fleet_planners() {
  static const std::vector<FleetPlanner> planners = {
      {.name = "prioritized",
       .sentence = "Plans one robot after another, each round the paths of those before it.",
       .paper = "Erdmann and Lozano-Perez, On multiple moving objects, 1987; Silver, Cooperative "
                "pathfinding, 2005",
       .complete = false,
       .optimal = false,
       .guarantee = "neither complete nor optimal; states a bound",
       .configure = with_options(prioritized)},
      {.name = "cbs",
       .sentence = "Plans each robot alone, and branches on who avoids the first collision.",
       .paper = "Sharon, Stern, Felner and Sturtevant, Conflict-based search for optimal multi-agent "
                "pathfinding, 2015",
       .complete = false,
       .optimal = true,
       .guarantee = "least sum of costs; finds a plan if there is one, but cannot prove that there is none",
       .configure = with_options(cbs)},
      {.name = "lacam",
       .sentence = "Searches the cells of all robots at once, with steps by priority inheritance (PIBT).",
       .paper = "Okumura, LaCAM: search-based algorithm for quick multi-agent pathfinding, 2023",
       .complete = true,
       .optimal = false,
       .guarantee = "complete: finds a plan, or proves that there is none; not optimal, and states a bound",
       .configure = with_options(lacam)},
  };
  return planners;
}

Outcome<FleetPlanner> find_fleet_planner(std::string_view name) {
  return find_row(fleet_planners(), "planner of fleets", name, "planner");
}

}  // namespace outrider
