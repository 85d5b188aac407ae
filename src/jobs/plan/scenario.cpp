#include "outrider/jobs/plan/scenario.hpp"

#include <fmt/format.h>

#include "outrider/io/files/text.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {
namespace {

OptionGroup describe_question(PlanScenario& scenario) {
  return {
      "",
      "the path",
      {file_option("map",
                   "file of a map: map_server .yaml, .sdf or .world, MovingAI .map, polygons .txt, "
                   "an image .png or .pgm (.gz may follow)",
                   &scenario.map),
       describe(scenario.sdf).front(),
       {"from", "", 0, 0,
        "x,y of the start, m (MovingAI: cells, y from the bottom); x,y,heading in degrees for a robot that "
        "steers",
        &scenario.from},
       {"to", "", 0, 0,
        "x,y or x,y,heading of the goal; several with blanks between: many goals from one start",
        &scenario.to},
       {"query", "", 0, 0, "instead, a query of a polygon environment: all, or a number from 1",
        &scenario.query},
       choice_option("planner",
                     "name from 'outrider list'; visibility_graph_reduced on polygons unless given",
                     &scenario.planner, names_of(path_planners())),
       {"compare", "", 0, 0,
        "asks every planner that takes the map, those of robots that steer if `planner` is one of them",
        &scenario.compare},
       {"model", "", 0, 0,
        "vertices of the paths on a grid: cells (their centres) or corners; corners on polygons unless given",
        &scenario.model},
       {"radius", "m", 0, 1e3,
        "radius of the robot, 0 on MovingAI maps and 0.18 on polygons unless given, or room around its "
        "footprint",
        &scenario.radius_m},
       {"footprint", "", 0, 0,
        "corners x,y of the robot, m, convex, counter-clockwise around its origin; radius is 0 then unless "
        "given",
        &scenario.footprint},
       {"height", "m", 0, 100, "height of the robot, for SDF worlds", &scenario.height_m}}};
}

std::vector<Option> describe_grid(PlanScenario& scenario) {
  std::vector<Option> options = describe(scenario.grid);
  for (Option& option : options) {
    if (option.name == "resolution") option.sentence += "; 0.05 on polygons unless given";
  }
  options.push_back({"trace", "", 0, 0, "shows what the search expands, on grids", &scenario.trace});
  options.push_back({"block", "", 0, 0,
                     "cells x,y or x,y,width,height, from the bottom left, that are blocked once the map is "
                     "read; several with blanks between",
                     &scenario.block});
  options.push_back({"free", "", 0, 0, "cells that are freed after that", &scenario.free});
  options.push_back({"index", "", 0, 0,
                     "file in which hub_labels, octile_labels or terrain_labels keeps its index: read where "
                     "it exists, else "
                     "written",
                     &scenario.index});
  options.push_back(file_option("costs",
                                "cost per metre of the ground: an image with a pixel for each cell of the "
                                "map (white 1), or an ESRI ASCII grid .asc",
                                &scenario.costs));
  options.push_back(
      {"cost_of_black", "", 1, 1e6, "cost per metre of a black pixel", &scenario.cost_of_black});
  options.push_back(file_option("terrain",
                                "heights for slope_cost, an ESRI ASCII grid .asc; those of the world unless "
                                "given",
                                &scenario.terrain));
  options.push_back({"slope_cost", "", 0, 1e6,
                     "cost per metre that a slope of 45 degrees adds, others in proportion to their tangent",
                     &scenario.slope_cost});
  return options;
}

}  // namespace

PlanScenario::PlanScenario() {
  for (const PathPlanner& row : path_planners()) planners.emplace_back(row, row.configure());
}

std::vector<OptionGroup> describe(PlanScenario& scenario) {
  OptionGroup question = describe_question(scenario);
  for (Option& option : describe_grid(scenario)) question.options.push_back(std::move(option));
  std::vector<OptionGroup> groups{
      std::move(question),
      {"drive", "the robot on its path, for the time of the fastest drive", describe(scenario.drive)}};
  for (const auto& [planner, configured] : scenario.planners) {
    if (configured.options.empty()) continue;
    const std::string name(planner.name);
    groups.push_back({name, "planner " + name, configured.options});
  }
  return groups;
}

bool has_costs(const PlanScenario& scenario) { return !scenario.costs.empty() || scenario.slope_cost > 0.0; }

Status check(const PlanScenario& scenario) {
  if (scenario.map.empty()) return bad_input("it is missing; name the file of a map", "map");
  if (!scenario.terrain.empty() && scenario.slope_cost == 0.0) {
    return bad_input("its slopes cost nothing; give slope_cost too, such as 5, or leave it out", "terrain");
  }
  if (!scenario.query.empty()) {
    if (scenario.from.empty() && scenario.to.empty()) return {};
    return bad_input("it stands beside from or to; give one or the other", "query");
  }
  for (const auto& [key, value] : {std::pair{"from", &scenario.from}, std::pair{"to", &scenario.to}}) {
    if (words(*value).empty()) {
      return bad_input("it is missing; give x,y in m, such as 1.5,-2, or on a polygon environment a query",
                       key);
    }
  }
  return {};
}

Outcome<GridModel> find_grid_model(const std::string& name) {
  for (const GridModel model : {GridModel::cells, GridModel::corners}) {
    if (to_string(model) == name) return model;
  }
  return bad_input(fmt::format("'{}' is not valid; expected cells or corners", excerpt(name)), "model");
}

Status check_takes(const PathPlanner& planner, GridModel model, bool has_polygons) {
  if (planner.takes(model) || (has_polygons && planner.polygons)) return {};
  return bad_input(
      fmt::format("{} takes {} a grid of {}; 'outrider list' says what each planner takes", planner.name,
                  has_polygons ? "neither polygons nor" : "polygons, not", to_string(model)),
      "planner");
}

PlanScenario settle(PlanScenario scenario, MapKind kind, const std::set<std::string>& given) {
  const bool is_disk = scenario.footprint.empty();
  if ((kind == MapKind::movingai || !is_disk) && !given.contains("radius")) scenario.radius_m = 0.0;
  const bool costs = has_costs(scenario);
  if (costs && !given.contains("planner")) scenario.planner = "terrain_theta_star";
  if (kind != MapKind::polygons) return scenario;
  if (is_disk && !given.contains("radius")) scenario.radius_m = 0.18;
  if (!costs && !given.contains("planner")) scenario.planner = "visibility_graph_reduced";
  if (!costs && !given.contains("model")) scenario.model = "corners";
  if (!given.contains("resolution")) scenario.grid.resolution_m = 0.05;
  return scenario;
}

}  // namespace outrider
