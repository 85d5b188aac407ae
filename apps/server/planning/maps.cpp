#include "planning/maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "outrider/core/base64.hpp"
#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_maps = 32;
constexpr std::size_t most_map_bytes = std::size_t{64} << 20U;

Json polygons_json(const PolygonMap& map) {
  Json obstacles = Json::array(), queries = Json::array();
  for (const auto& corners : map.obstacles) obstacles.push_back(points_json(corners));
  for (std::size_t i = 0; i < std::min(map.queries.size(), most_map_queries); ++i) {
    const PointQuery& query = map.queries[i];
    queries.push_back({{"start", {query.start.x, query.start.y}}, {"goal", {query.goal.x, query.goal.y}}});
  }
  return {{"boundary", points_json(map.boundary)}, {"obstacles", obstacles}, {"queries", queries}};
}

Json shape_json(const KnownMap& map) {
  if (const auto* cells = std::get_if<MapCells>(&map.shape)) {
    return {{"grid", grid_json(cells->occupancy, cells->yaw_rad)}};
  }
  return {{"polygons", polygons_json(std::get<PolygonMap>(map.shape))}};
}

/// Returns the bytes that identify a map.
std::string identity_of(const KnownMap& map) {
  const auto* cells = std::get_if<MapCells>(&map.shape);
  if (cells == nullptr) return text_of(shape_json(map));
  const GridFrame& frame = cells->occupancy.frame;
  const auto& bytes = cells->occupancy.cells;
  return fmt::format("{} {} {} {} {} {} ", frame.origin.x, frame.origin.y, frame.resolution_m, frame.width,
                     frame.height, cells->yaw_rad)
      .append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Computes the 64-bit FNV-1a hash. It names a map and offers no security.
std::string hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

/// Decodes the cells from runs, row by row. Records a fault in `fields`.
std::vector<std::uint8_t> cells_of_runs(Fields& fields, std::size_t count) {
  std::vector<std::uint8_t> cells;
  const Json* runs = fields.list("runs");
  if (runs == nullptr) return cells;
  for (std::size_t i = 0; i + 1 < runs->size(); i += 2) {
    const Json &value = (*runs)[i], &length = (*runs)[i + 1];
    const bool good = value.is_number_unsigned() && value.get<std::uint64_t>() <= unknown_cell &&
                      length.is_number_unsigned() && length.get<std::uint64_t>() <= count - cells.size();
    if (!good) {
      fields.refuse("runs", fmt::format("entry {} is not valid; runs are value (0, 1 or 2), count, ... and "
                                        "fill {} cells",
                                        i, count));
      return cells;
    }
    cells.insert(cells.end(), length.get<std::size_t>(), value.get<std::uint8_t>());
  }
  if (runs->size() % 2 != 0 || cells.size() != count) {
    fields.refuse("runs", fmt::format("they fill {} cells of {}", cells.size(), count));
  }
  return cells;
}

/// Reads the frame and the yaw of a grid. Records a fault in `fields`.
MapCells empty_grid(Fields& fields) {
  MapCells cells;
  GridFrame& frame = cells.occupancy.frame;
  frame.origin = fields.point("origin", Vec2{});
  frame.resolution_m = fields.number("resolution_m", 1e-4, 1e3);
  frame.width = static_cast<int>(fields.integer("width", 1, 100'000));
  frame.height = static_cast<int>(fields.integer("height", 1, 100'000));
  cells.yaw_rad = fields.number("yaw_rad", -7.0, 7.0, 0.0);
  if (frame.size() > most_map_cells) {
    fields.refuse("width", fmt::format("{} x {} cells are more than 4 million", frame.width, frame.height));
  }
  return cells;
}

Outcome<KnownMap> unpacked_cells(const Json& packed) {
  Fields fields(packed, "cells");
  MapCells cells = empty_grid(fields);
  const auto bytes = base64_decoded(fields.text("base64"));
  if (!bytes || bytes->size() != cells.occupancy.frame.size() ||
      std::ranges::any_of(*bytes, [](char c) { return static_cast<unsigned char>(c) > unknown_cell; })) {
    fields.refuse("base64", "these are not the cells of the grid");
  }
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  cells.occupancy.cells.assign(bytes->begin(), bytes->end());
  return KnownMap{{}, {}, std::move(cells), {}};
}

/// Returns cells or polygons; a world becomes the polygons that block the robot.
Outcome<MapShape> shape_of(MapShape shape, double robot_height_m) {
  const auto* world = std::get_if<World>(&shape);
  if (world == nullptr) return shape;
  auto polygons = polygons_of(*world, robot_height_m);
  return polygons ? Outcome<MapShape>(std::move(*polygons)) : pass_on(polygons);
}

std::size_t memory_of(const KnownMap& map) {
  const auto* cells = std::get_if<MapCells>(&map.shape);
  return cells == nullptr ? 0 : cells->occupancy.cells.size();
}

}  // namespace

Json points_json(const std::vector<Vec2>& points) {
  Json list = Json::array();
  for (const Vec2 p : points) list.push_back({p.x, p.y});
  return list;
}

double usual_radius_m(MapKind kind) { return settle({}, kind, {}).radius_m; }

Outcome<ReadMap> read_map(const std::string& path, double robot_height_m) {
  auto map = load_map(path, {.most_cells = most_map_cells});
  if (!map) return pass_on(map);
  auto shape = shape_of(std::move(map->shape), robot_height_m);
  if (!shape) return pass_on(shape);
  return ReadMap{{{},
                  path.substr(path.rfind('/') + 1),
                  std::move(*shape),
                  std::move(map->warnings),
                  usual_radius_m(map->kind)},
                 map->kind};
}

Json grid_json(const Grid<std::uint8_t>& cells, double yaw_rad) {
  const GridFrame& frame = cells.frame;
  Json runs = Json::array();
  for (std::size_t i = 0; i < cells.cells.size();) {
    std::size_t end = i;
    while (end < cells.cells.size() && cells.cells[end] == cells.cells[i]) ++end;
    runs.push_back(static_cast<int>(cells.cells[i]));
    runs.push_back(end - i);
    i = end;
  }
  return {{"origin", {frame.origin.x, frame.origin.y}},
          {"resolution_m", frame.resolution_m},
          {"width", frame.width},
          {"height", frame.height},
          {"runs", std::move(runs)},
          {"yaw_rad", yaw_rad}};
}

Json map_json(const KnownMap& map) {
  Json object = {{"id", map.id}, {"name", map.name}, {"radius_m", map.radius_m}, {"warnings", map.warnings}};
  object.update(shape_json(map));
  return object;
}

Json packed(const KnownMap& map) {
  Json object = {{"name", map.name}, {"radius_m", map.radius_m}, {"warnings", map.warnings}};
  if (const auto* cells = std::get_if<MapCells>(&map.shape)) {
    const GridFrame& frame = cells->occupancy.frame;
    const auto& bytes = cells->occupancy.cells;
    object["cells"] = {
        {"origin", {frame.origin.x, frame.origin.y}},
        {"resolution_m", frame.resolution_m},
        {"width", frame.width},
        {"height", frame.height},
        {"yaw_rad", cells->yaw_rad},
        {"base64", base64_encoded({reinterpret_cast<const char*>(bytes.data()), bytes.size()})}};
  } else {
    object["polygons"] = polygons_json(std::get<PolygonMap>(map.shape));
  }
  return object;
}

Outcome<KnownMap> unpacked(const Json& packed) {
  Outcome<KnownMap> map = packed.contains("polygons") ? polygon_map_from_json(packed["polygons"], "polygons")
                                                      : unpacked_cells(packed.value("cells", Json()));
  if (!map) return map;
  map->name = packed.value("name", "");
  map->radius_m = packed.value("radius_m", map->radius_m);
  map->warnings = packed.value("warnings", std::vector<std::string>{});
  return map;
}

Outcome<KnownMap> grid_map_from_json(const Json& grid, const std::string& where) {
  Fields fields(grid, where);
  MapCells cells = empty_grid(fields);
  const std::size_t size = cells.occupancy.frame.size();
  if (size <= most_map_cells) cells.occupancy.cells = cells_of_runs(fields, size);
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  return KnownMap{{}, "drawn", std::move(cells), {}};
}

Outcome<KnownMap> polygon_map_from_json(const Json& polygons, const std::string& where) {
  Fields fields(polygons, where);
  PolygonMap map;
  map.boundary = fields.polygon("boundary");
  const Json* obstacles = fields.list("obstacles");
  const Json* queries = fields.list("queries");
  std::size_t corners = map.boundary.size();
  for (std::size_t i = 0; obstacles != nullptr && i < obstacles->size(); ++i) {
    const std::string name = fmt::format("obstacles[{}]", i);
    Json wrapped = {{name, (*obstacles)[i]}};
    Fields one(wrapped, where);
    map.obstacles.push_back(one.polygon(name));
    if (auto ok = one.end(); !ok) return pass_on(ok);
    corners += map.obstacles.back().size();
  }
  for (std::size_t i = 0; queries != nullptr && i < std::min(queries->size(), most_map_queries); ++i) {
    Fields one((*queries)[i], fields.place(fmt::format("queries[{}]", i)));
    map.queries.push_back({one.point("start"), one.point("goal")});
    if (auto ok = one.end(); !ok) return pass_on(ok);
  }
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (corners > most_polygon_corners) {
    return bad_input(fmt::format("{} corners are too many; expected {}", corners, most_polygon_corners),
                     where);
  }
  return KnownMap{{}, "drawn", std::move(map), {}, usual_radius_m(MapKind::polygons)};
}

std::shared_ptr<const KnownMap> MapStore::keep(KnownMap map) {
  map.id = hash_of(identity_of(map));
  auto kept = std::make_shared<const KnownMap>(std::move(map));
  const std::lock_guard lock(mutex_);
  maps_.remove_if([&](const auto& other) { return other->id == kept->id; });
  maps_.push_front(kept);
  std::size_t bytes = 0;
  for (const auto& each : maps_) bytes += memory_of(*each);
  for (; maps_.size() > most_maps || (bytes > most_map_bytes && maps_.size() > 1); maps_.pop_back()) {
    bytes -= memory_of(*maps_.back());
  }
  return kept;
}

std::shared_ptr<const KnownMap> MapStore::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(maps_.begin(), maps_.end(), [&](const auto& map) { return map->id == id; });
  if (found == maps_.end()) return nullptr;
  maps_.splice(maps_.begin(), maps_, found);
  return maps_.front();
}

}  // namespace outrider::server
