#include "maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "outrider/path/grid_ground.hpp"
#include "outrider/path/polygon_ground.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_maps = 32;

Json points_json(const std::vector<Vec2>& points) {
  Json list = Json::array();
  for (const Vec2 p : points) list.push_back({p.x, p.y});
  return list;
}

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
  if (const auto* cells = std::get_if<CellMap>(&map.shape)) {
    return {{"grid", grid_json(cells->occupancy, cells->yaw_rad)}};
  }
  return {{"polygons", polygons_json(std::get<PolygonMap>(map.shape))}};
}

/// FNV-1a, 64 bits: a name for a map, no protection from anybody.
std::string hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

/// The cells of the runs, row by row. `fields` takes the fault.
std::vector<std::uint8_t> cells_of_runs(Fields& fields, std::size_t count) {
  std::vector<std::uint8_t> cells;
  const Json* runs = fields.list("runs");
  if (runs == nullptr) return cells;
  for (std::size_t i = 0; i + 1 < runs->size(); i += 2) {
    const Json &value = (*runs)[i], &length = (*runs)[i + 1];
    const bool good = value.is_number_unsigned() && value.get<std::uint64_t>() <= unknown_cell &&
                      length.is_number_unsigned() && length.get<std::uint64_t>() <= count - cells.size();
    if (!good) {
      fields.refuse("runs", fmt::format("entry {} is no good; runs are value (0, 1 or 2), count, ... and "
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

}  // namespace

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

Outcome<KnownMap> grid_map_from_json(const Json& grid, const std::string& where) {
  Fields fields(grid, where);
  GridFrame frame;
  frame.origin = fields.point("origin", Vec2{});
  frame.resolution_m = fields.number("resolution_m", 1e-4, 1e3);
  frame.width = static_cast<int>(fields.integer("width", 1, 100'000));
  frame.height = static_cast<int>(fields.integer("height", 1, 100'000));
  CellMap cells;
  cells.yaw_rad = fields.number("yaw_rad", -7.0, 7.0, 0.0);
  cells.occupancy.frame = frame;
  if (frame.size() > most_map_cells) {
    fields.refuse("width", fmt::format("{} x {} cells are more than 4 million", frame.width, frame.height));
  } else {
    cells.occupancy.cells = cells_of_runs(fields, frame.size());
  }
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
    return bad_input(fmt::format("{} corners are too many; it takes {}", corners, most_polygon_corners),
                     where);
  }
  return KnownMap{{}, "drawn", std::move(map), {}};
}

std::shared_ptr<const KnownMap> MapStore::keep(KnownMap map) {
  map.id = hash_of(text_of(shape_json(map)));
  auto kept = std::make_shared<const KnownMap>(std::move(map));
  const std::lock_guard lock(mutex_);
  maps_.remove_if([&](const auto& other) { return other->id == kept->id; });
  maps_.push_front(kept);
  if (maps_.size() > most_maps) maps_.pop_back();
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
