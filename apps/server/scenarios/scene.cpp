#include "scenarios/scene.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "outrider/io/map/cover_area.hpp"
#include "outrider/io/map/pursuit_map.hpp"
#include "outrider/io/map/world_file.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"
#include "planning/maps.hpp"
#include "scenarios/yard_scenarios.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr double robot_height_m = 0.2;

struct Scene {
  std::optional<MapShape> shape;
  std::optional<Vec2> start;
  std::vector<Vec2> targets;
  std::vector<std::vector<Vec2>> other_boundaries = {};  ///< of further areas
};

MapCells coarser(const MapCells& map) {
  const GridFrame& fine = map.occupancy.frame;
  const int step = (std::max(fine.width, fine.height) + most_scene_cells - 1) / most_scene_cells;
  if (step <= 1) return map;
  GridFrame frame = fine;
  frame.resolution_m *= step;
  frame.width = (fine.width + step - 1) / step;
  frame.height = (fine.height + step - 1) / step;
  Grid<std::uint8_t> cells(frame, 2);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      std::uint8_t& cell = cells[{x / step, y / step}];
      const std::uint8_t value = map.occupancy[{x, y}];
      if (value == 1 || (value == 0 && cell == 2)) cell = value;
    }
  }
  return {std::move(cells), map.yaw_rad};
}

std::optional<Vec2> point_in(const YAML::Node& scenario, const char* key) {
  const std::string text = scenario[key] && scenario[key].IsScalar() ? scenario[key].Scalar() : "";
  for (const std::size_t count : {3U, 2U}) {
    if (const auto numbers = parse_numbers(text, count, key, "x,y"))
      return Vec2{(*numbers)[0], (*numbers)[1]};
  }
  return std::nullopt;
}

Outcome<Scene> pursuit_scene(const std::string& file) {
  auto problem = load_pursuit_map(file);
  if (!problem) return pass_on(problem);
  const GridFrame& frame = problem->costs->frame;
  Grid<std::uint8_t> walls(frame);
  for (std::size_t i = 0; i < walls.cells.size(); ++i) {
    walls.cells[i] = problem->costs->cells[i] >= problem->threshold ? 1 : 0;
  }
  const auto middle = [&](Cell cell) {
    return frame.origin + frame.resolution_m * Vec2{cell.x + 0.5, cell.y + 0.5};
  };
  Scene scene{MapCells{std::move(walls)}, middle(problem->start), {}};
  if (!problem->target.empty()) scene.targets.push_back(middle(problem->target.front()));
  return scene;
}

Outcome<Scene> area_scene(const std::string& file) {
  auto area = load_cover_area(file);
  if (!area) return pass_on(area);
  PolygonMap map;
  std::vector<std::vector<Vec2>> boundaries;
  for (const AreaPolygon& polygon : area->polygons) {
    boundaries.push_back(polygon.boundary.corners);
    for (const AreaRing& hole : polygon.holes) map.obstacles.push_back(hole.corners);
  }
  map.boundary = std::move(boundaries.front());
  boundaries.erase(boundaries.begin());
  return Scene{std::move(map), {}, {}, std::move(boundaries)};
}

/// Returns what blocks a robot. A wall without a thickness has two corners, which a planner would refuse.
PolygonMap seen_from_above(const World& world) {
  const CollisionMap ground = CollisionMap::of(world, robot_height_m);
  const auto& [low, high] = ground.bounds();
  PolygonMap map{{low, {high.x, low.y}, high, {low.x, high.y}}, {}, {}};
  for (const RoundedPolygon& obstacle : ground.obstacles()) {
    if (map.obstacles.size() < most_scene_obstacles) map.obstacles.push_back(outline(obstacle));
  }
  return map;
}

Outcome<Scene> world_scene(const fs::path& file, const YAML::Node& scenario) {
  const auto text = [&](const char* key) { return scenario[key] ? scenario[key].as<std::string>("") : ""; };
  const bool cells = file.extension() != ".sdf" && file.extension() != ".world" && file.extension() != ".csv";
  if (cells) {
    auto read = read_map(file.string(), robot_height_m);
    if (read) return Scene{std::move(read->map.shape), {}, {}};
  }
  auto world = load_explore_world({.world = file.string(), .walls = text("walls")});
  if (!world) return pass_on(world);
  return Scene{seen_from_above(world->world), {}, {}};
}

/// Reads the ground that one of the keys names.
Outcome<Scene> scene_of(const fs::path& file, const YAML::Node& scenario) {
  for (const char* key : {"world", "map", "area"}) {
    if (!scenario[key] || !scenario[key].IsScalar()) continue;
    const fs::path named = (file.parent_path() / scenario[key].Scalar()).lexically_normal();
    if (std::string_view(key) == "area") return area_scene(named.string());
    const bool pursuit = scenario["job"] && scenario["job"].as<std::string>("") == "pursue";
    return pursuit ? pursuit_scene(named.string()) : world_scene(named, scenario);
  }
  return Scene{};
}

Outcome<Json> guard_scene(const fs::path& file) {
  auto yard = shown_yard(file);
  if (!yard) return yard;
  Json targets = Json::array();
  for (const Json& target : (*yard)["targets"])
    targets.push_back({target["position"][0], target["position"][1]});
  Json map = {{"name", (*yard)["map"]["name"]}, {"polygons", std::move((*yard)["map"]["polygons"])}};
  return Json{
      {"map", std::move(map)}, {"start", std::move((*yard)["start"])}, {"targets", std::move(targets)}};
}

Json shown_map(const fs::path& file, MapShape shape) {
  KnownMap map;
  map.name = file.filename().string();
  const auto* cells = std::get_if<MapCells>(&shape);
  map.shape = cells == nullptr ? std::move(shape) : MapShape(coarser(*cells));
  Json shown = map_json(map);
  for (const char* key : {"id", "radius_m", "warnings"}) shown.erase(key);
  return shown;
}

}  // namespace

Outcome<Json> scenario_scene(const std::string& path) {
  const fs::path file = path;
  auto text = read_file(path, largest_saved_bytes);
  if (!text) return pass_on(text);
  YAML::Node scenario;
  try {
    scenario = YAML::Load(*text);
  } catch (const YAML::Exception& broken) {
    return bad_input(broken.what());
  }
  if (!scenario.IsMap()) return bad_input("the scenario has no keys");
  const auto job = scenario_job_from_text(*text, path);
  if (job && *job == "guard") return guard_scene(file);
  auto scene = scene_of(file, scenario);
  if (!scene) return pass_on(scene);
  for (const char* key : {"start", "from"}) {
    if (!scene->start) scene->start = point_in(scenario, key);
  }
  Json targets = Json::array();
  for (const Vec2 at : scene->targets) targets.push_back({at.x, at.y});
  Json map = scene->shape ? shown_map(file, std::move(*scene->shape)) : Json();
  for (const auto& boundary : scene->other_boundaries) map["others"].push_back(points_json(boundary));
  return Json{{"map", std::move(map)},
              {"start", scene->start ? Json{scene->start->x, scene->start->y} : Json()},
              {"targets", std::move(targets)}};
}

}  // namespace outrider::server
