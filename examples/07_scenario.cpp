// The mission of a scenario file: load it, change an option by its name, and write the report.
#include <fmt/format.h>

#include "outrider/io/scenario.hpp"
#include "outrider/jobs/guard/scenario.hpp"

using namespace outrider;

int main() {
  const std::string path = "scenarios/yard/yard.yaml";
  GuardScenario scenario;
  const auto groups = describe(scenario);
  if (const auto loaded = load_scenario(path, groups); !loaded) {
    fmt::print("{}\n", to_string(loaded.error()));
    return 1;
  }
  resolve_paths(scenario, path);
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      if (group.name != "robot" || option.name != "radius") continue;
      if (!assign(option, "0.3")) return 1;
      if (const auto refused = assign(option, "-1"); !refused) fmt::print("{}\n", to_string(refused.error()));
    }
  }
  const auto warnings = load_problem(scenario);
  if (!warnings) return 1;
  fmt::print("{} targets in {}, a robot of {} m, {} warnings\n", scenario.problem.targets.size(),
             scenario.problem.world.name, scenario.problem.robot.radius_m, warnings->size());
  const auto typo = scenario_from_text("robot:\n  raduis: 0.3\n", "typo.yaml", groups);
  if (!typo) fmt::print("{}\n", to_string(typo.error()));
}

// Prints:
// radius: '-1' is no good; it takes a number from 0 to 100 m
// 24 targets in yard, a robot of 0.3 m, 0 warnings
// typo.yaml:2: 'robot.raduis' is no known key; did you mean 'radius'?
