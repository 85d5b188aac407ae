#include "outrider/jobs/plan/scenario.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "outrider/io/text.hpp"

namespace outrider {

PlanScenario::PlanScenario() {
  for (const PathPlanner& row : path_planners()) planners.emplace_back(row, row.configure());
}

std::vector<OptionGroup> describe(PlanScenario& scenario) {
  OptionGroup question{
      "",
      "the path",
      {{"job", "", 0, 0, "what is asked for; plan", &scenario.job},
       {"map", "", 0, 0, "file of a map: .yaml of map_server, .sdf, .world, .map or .txt (.gz may follow)",
        &scenario.map},
       {"from", "", 0, 0, "x,y of the start, m (MovingAI: cells, y from the bottom)", &scenario.from},
       {"to", "", 0, 0, "x,y of the goal, m", &scenario.to},
       {"planner", "", 0, 0, "name from 'outrider list'", &scenario.planner},
       {"model", "", 0, 0, "vertices of the paths on a grid: cells (their centres) or corners",
        &scenario.model},
       {"radius", "m", 0, 1e3, "radius of the robot", &scenario.radius_m},
       {"height", "m", 0, 100, "height of the robot, for SDF worlds", &scenario.height_m}}};
  for (Option& option : describe(scenario.grid)) question.options.push_back(std::move(option));
  std::vector<OptionGroup> groups{std::move(question)};
  for (const auto& [planner, configured] : scenario.planners) {
    if (configured.options.empty()) continue;
    const std::string name(planner.name);
    groups.push_back({name, "planner " + name, configured.options});
  }
  return groups;
}

void resolve_paths(PlanScenario& scenario, const std::string& scenario_path) {
  if (scenario.map.empty()) return;
  const auto folder = std::filesystem::path(scenario_path).parent_path();
  scenario.map = (folder / scenario.map).lexically_normal().string();
}

Status check(const PlanScenario& scenario) {
  if (scenario.job != "plan") {
    return bad_input(
        fmt::format("'{}' is not a job of this scenario; the job is plan", excerpt(scenario.job)), "job");
  }
  if (scenario.map.empty()) return bad_input("it is missing; name the file of a map", "map");
  for (const auto& [key, value] : {std::pair{"from", &scenario.from}, std::pair{"to", &scenario.to}}) {
    if (value->empty()) return bad_input("it is missing; give x,y in m, such as 1.5,-2", key);
  }
  return {};
}

}  // namespace outrider
