#include "outrider/jobs/plan/task.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/files/files.hpp"
#include "outrider/io/map/terrain.hpp"
#include "outrider/motion/footprint.hpp"
#include "queries.hpp"

namespace outrider {
namespace {

/// The planner that is named, or all that take such a ground.
Outcome<std::vector<ChosenPlanner>> chosen(const PlanScenario& scenario, const PlanGroundOptions& ground) {
  std::vector<ChosenPlanner> planners = scenario.planners;
  const bool costs = has_costs(scenario);
  if (scenario.compare) {
    const auto named = find_path_planner(scenario.planner);
    const bool steers = named && named->steers;
    std::erase_if(planners, [&](const ChosenPlanner& planner) {
      return planner.first.steers != steers || (costs && !planner.first.weighs) ||
             !check_takes(planner.first, ground.model, ground.as_polygons);
    });
    return planners;
  }
  auto named = find_path_planner(scenario.planner);
  if (!named) return bad_input(named.error().sentence, "planner");
  if (costs && !named->weighs) {
    return bad_input(fmt::format("{} does not weigh the costs of the ground; take terrain_theta_star, "
                                 "terrain_a_star or terrain_labels, or leave out costs and slope_cost",
                                 named->name),
                     "planner");
  }
  if (auto ok = check_takes(*named, ground.model, ground.as_polygons); !ok) return pass_on(ok);
  std::erase_if(planners, [&](const ChosenPlanner& planner) { return planner.first.name != named->name; });
  return planners;
}

/// True for a polygon environment, and a world of solids that is asked of a planner on polygons.
bool takes_polygons(const PlanScenario& scenario, MapKind kind) {
  if (kind == MapKind::polygons) return true;
  const auto planner = find_path_planner(scenario.planner);
  return !scenario.compare && kind == MapKind::world && planner && planner->models.empty();
}

/// Checks that the task fits a trace, if one is asked for: a trace shows one search on a grid.
Status check_trace(const PlanTask& task) {
  if (!task.settled.trace) return {};
  if (task.ground.as_polygons)
    return bad_input("it shows searches on grids; leave it out, or take a grid", "trace");
  if (task.planners.size() > 1 || task.queries.size() > 1)
    return bad_input("it shows one search; leave out compare, and give one goal", "trace");
  return {};
}

/// Checks that the task fits an index file, if one is named: it keeps the index of one planner.
Status check_index(const PlanTask& task) {
  if (task.settled.index.empty()) return {};
  if (task.planners.size() != 1)
    return bad_input("it keeps the index of one planner; leave out compare", "index");
  if (task.planners.front().second.save_index) return {};
  return bad_input(
      fmt::format("{} has no index that can be kept; take hub_labels, octile_labels or terrain_labels",
                  task.planners.front().first.name),
      "index");
}

Status set_costs(PlanTask& task) {
  const PlanScenario& scenario = task.settled;
  PlanCostOptions& costs = task.ground.costs;
  if (!scenario.costs.empty()) {
    auto map = load_cost_map(scenario.costs, scenario.cost_of_black);
    if (!map) return pass_on(map);
    costs.map = std::make_shared<const CostMap>(std::move(*map));
  }
  costs.per_slope = scenario.slope_cost;
  if (costs.per_slope == 0.0) return {};
  if (!scenario.terrain.empty()) {
    const auto text = read_file(scenario.terrain);
    if (!text) return pass_on(text);
    auto terrain = terrain_from_grid(*text, scenario.terrain);
    if (!terrain) return pass_on(terrain);
    costs.terrain = std::make_shared<const HeightField>(std::move(*terrain));
    return {};
  }
  if (const auto* world = std::get_if<World>(&task.map.shape)) costs.terrain = world->terrain;
  if (costs.terrain == nullptr) {
    return bad_input("it needs slopes, and the map has none; give the heights as terrain, a file .asc",
                     "slope_cost");
  }
  return {};
}

/// Sets the outline of a robot that steers; of another one the disk about it grows the ground.
Status set_outline(PlanGroundOptions& ground, const PlanScenario& scenario) {
  if (scenario.footprint.empty()) return {};
  auto shape = parse_footprint(scenario.footprint);
  if (!shape) return pass_on(shape);
  if (shape->core.size() < 3)
    return bad_input("it is a disk; give its corners, or leave it out and give the radius", "footprint");
  const auto planner = find_path_planner(scenario.planner);
  if (planner && planner->steers) {
    ground.outline = std::move(shape->core);
  } else {
    ground.radius_m += Footprint(*shape).outer_m();
  }
  return {};
}

Status set_ground_options(PlanTask& task) {
  const PlanScenario& scenario = task.settled;
  auto model = find_grid_model(scenario.model);
  if (!model) return pass_on(model);
  auto changes = cell_changes(scenario);
  if (!changes) return pass_on(changes);
  PlanGroundOptions& ground = task.ground;
  ground = {scenario.radius_m, scenario.height_m, *model, scenario.grid};
  if (auto ok = set_outline(ground, scenario); !ok) return ok;
  ground.as_polygons = takes_polygons(scenario, task.map.kind);
  ground.changes = std::move(*changes);
  return set_costs(task);
}

}  // namespace

Outcome<PlanTask> load_plan(const PlanScenario& scenario, const std::set<std::string>& given) {
  if (auto ok = check(scenario); !ok) return pass_on(ok);
  auto map = load_map(scenario.map, {.sdf = scenario.sdf});
  if (!map) return pass_on(map);
  PlanTask task{settle(scenario, map->kind, given), std::move(*map), {}, {}, {}};
  if (auto ok = set_ground_options(task); !ok) return pass_on(ok);
  auto planners = chosen(task.settled, task.ground);
  if (!planners) return pass_on(planners);
  task.planners = std::move(*planners);
  task.ground.needs_grid =
      !task.ground.as_polygons || !std::all_of(task.planners.begin(), task.planners.end(),
                                               [](const ChosenPlanner& p) { return p.first.polygons; });
  auto queries = queries_of(task.settled, task.map);
  if (!queries) return pass_on(queries);
  task.queries = std::move(*queries);
  if (auto ok = check_trace(task); !ok) return pass_on(ok);
  if (auto ok = check_index(task); !ok) return pass_on(ok);
  return task;
}

Outcome<PlanQuestion> question_of(const PlanTask& task, const std::stop_token& stop) {
  PlanGroundOptions options = task.ground;
  options.stop = stop;
  auto ground = plan_ground(task.map.shape, options);
  if (!ground) return pass_on(ground);
  return PlanQuestion{std::make_shared<const PlanGround>(std::move(*ground)), task.planners, task.queries,
                      task.settled.drive};
}

}  // namespace outrider
