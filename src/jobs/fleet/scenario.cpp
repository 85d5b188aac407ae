#include <fmt/format.h>

#include <algorithm>

#include "fleet_task.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider {
namespace {

constexpr double most_radius_cells = 0.35;  // see fleet.hpp

Outcome<std::vector<Vec2>> points_of_key(const std::string& text, const std::string& key) {
  std::vector<Vec2> points;
  for (const std::string_view word : words(text)) {
    if (points.size() == most_fleet_robots)
      return bad_input(fmt::format("it has more than {} points, the most of a fleet", most_fleet_robots),
                       key);
    auto numbers = parse_numbers(std::string(word), 2, key, "x,y in m for each robot, such as 1.5,2.5");
    if (!numbers) return pass_on(numbers);
    points.push_back({(*numbers)[0], (*numbers)[1]});
  }
  return points;
}

Status set_ends(const FleetScenario& scenario, FleetProblem& problem) {
  auto starts = points_of_key(scenario.starts, "starts");
  if (!starts) return pass_on(starts);
  auto goals = points_of_key(scenario.goals, "goals");
  if (!goals) return pass_on(goals);
  if (starts->empty()) {
    return bad_input("it is missing; give x,y for each robot, or agents, a scenario of MovingAI", "starts");
  }
  if (starts->size() != goals->size()) {
    return bad_input(
        fmt::format("{} goals came with {} starts; give one for each robot", goals->size(), starts->size()),
        "goals");
  }
  problem.starts = std::move(*starts);
  problem.goals = std::move(*goals);
  return {};
}

Status read_agents(const FleetScenario& scenario, FleetProblem& problem) {
  if (!scenario.starts.empty() || !scenario.goals.empty())
    return bad_input("it stands beside starts or goals; give one or the other", "agents");
  auto rows = load_movingai_scenario(scenario.agents);
  if (!rows) return pass_on(rows);
  const GridFrame& frame = problem.grid->frame;
  const auto count = scenario.robots == 0 ? rows->size() : static_cast<std::size_t>(scenario.robots);
  if (count > rows->size()) {
    return bad_input(
        fmt::format("{} robots are more than the {} rows of {}", count, rows->size(), scenario.agents),
        "robots");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const MovingAiQuery& row = (*rows)[i];
    if (row.width != frame.width || row.height != frame.height) {
      return bad_input(fmt::format("row {} is for a map of {} x {} cells, and this one has {} x {}", i + 1,
                                   row.width, row.height, frame.width, frame.height),
                       scenario.agents);
    }
    problem.starts.push_back(frame.centre(row.start));
    problem.goals.push_back(frame.centre(row.goal));
  }
  return {};
}

Outcome<std::shared_ptr<const GridMap>> grid_of(const FleetScenario& scenario) {
  if (scenario.map.empty()) return bad_input("it is missing; name the file of a map", "map");
  auto map = load_map(scenario.map, {.image_resolution_m = scenario.resolution_m});
  if (!map) return pass_on(map);
  const auto* cells = std::get_if<MapCells>(&map->shape);
  if (cells == nullptr || cells->yaw_rad != 0.0) {
    return bad_input(
        "fleets drive on maps of cells that are not turned; take a map_server map, a MovingAI map, or an "
        "image",
        scenario.map);
  }
  const double most_m = most_radius_cells * cells->occupancy.frame.resolution_m;
  if (scenario.radius_m > most_m) {
    return bad_input(
        fmt::format(
            "robots of {} m would touch each other in cells of {} m; take at most {:g} m, or a map of "
            "larger cells",
            short_number(scenario.radius_m), short_number(cells->occupancy.frame.resolution_m), most_m),
        "radius");
  }
  auto blocked = inflated(cells->occupancy, scenario.radius_m);
  if (!blocked) return pass_on(blocked);
  auto grid = GridMap::of(*blocked, GridModel::cells);
  if (!grid) return pass_on(grid);
  return std::make_shared<const GridMap>(std::move(*grid));
}

}  // namespace

FleetScenario::FleetScenario() {
  for (const FleetPlanner& row : fleet_planners()) planners.emplace_back(row, row.configure());
}

std::vector<OptionGroup> describe(FleetScenario& scenario) {
  std::vector<OptionGroup> groups = {
      {"",
       "the fleet",
       {file_option("map", "file of a map of cells: map_server .yaml, MovingAI .map, an image .png or .pgm",
                    &scenario.map),
        {"starts", "", 0, 0, "x,y of each robot, m, with blanks between (MovingAI: cells, y from the bottom)",
         &scenario.starts},
        {"goals", "", 0, 0, "x,y of the goal of each robot, in the same order", &scenario.goals},
        file_option("agents", "instead, a scenario of MovingAI .scen with a robot in each row",
                    &scenario.agents),
        {"robots", "", 0, static_cast<double>(most_fleet_robots),
         "robots taken from its beginning; 0 takes all", &scenario.robots},
        choice_option("planner", "name from 'outrider list'", &scenario.planner, names_of(fleet_planners())),
        {"radius", "m", 0, 1e3, "radius of each robot, at most 0.35 cells", &scenario.radius_m},
        {"resolution", "m", 1e-4, 1e3, "side of a pixel, for an image alone", &scenario.resolution_m},
        {"budget", "", 0, 1e15, "expansions after which the search is given up; 0: unlimited",
         &scenario.budget}}}};
  for (const auto& [planner, configured] : scenario.planners) {
    groups.push_back({std::string(planner.name), "planner " + std::string(planner.name), configured.options});
  }
  return groups;
}

Outcome<FleetProblem> load_fleet(const FleetScenario& scenario) {
  if (auto named = find_fleet_planner(scenario.planner); !named) return pass_on(named);
  auto grid = grid_of(scenario);
  if (!grid) return pass_on(grid);
  FleetProblem problem{std::move(*grid), {}, {}};
  auto ok = scenario.agents.empty() ? set_ends(scenario, problem) : read_agents(scenario, problem);
  if (!ok) return pass_on(ok);
  return problem;
}

}  // namespace outrider
