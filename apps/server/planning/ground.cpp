#include "planning/ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_grounds = 16;
constexpr std::size_t most_edits = 10'000;

Edit cell_edit(Fields& fields) {
  const bool blocks = fields.has("block");
  const auto numbers = fields.integers(blocks ? "block" : "free", 4);
  const auto whole = [&](std::size_t i) { return static_cast<int>(numbers[i]); };
  return {blocks ? Edit::Kind::block : Edit::Kind::free,
          {{whole(0), whole(1)}, whole(2), whole(3), blocks},
          0,
          {}};
}

Edit polygon_edit(Fields& fields) {
  Edit edit;
  constexpr auto most = static_cast<std::int64_t>(most_polygon_corners);
  if (fields.has("add")) return {Edit::Kind::add, {}, 0, fields.polygon("add")};
  edit.kind = fields.has("set") ? Edit::Kind::set : Edit::Kind::remove;
  const bool sets = edit.kind == Edit::Kind::set;
  edit.obstacle = static_cast<std::size_t>(fields.integer(sets ? "set" : "remove", 0, most));
  if (sets) edit.corners = fields.polygon("polygon");
  return edit;
}

/// Returns the cells after the edits, all of which must lie on the grid.
Outcome<Grid<std::uint8_t>> edited(const MapCells& map, const std::vector<Edit>& edits) {
  Grid<std::uint8_t> cells = map.occupancy;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const CellChange& change = edits[i].cells;
    const GridFrame& frame = cells.frame;
    const auto within = [](int low, int size, int all) { return low >= 0 && size > 0 && size <= all - low; };
    if (!within(change.low.x, change.width, frame.width) ||
        !within(change.low.y, change.height, frame.height)) {
      return bad_input(fmt::format("the rectangle leaves the grid of {} x {} cells, or is empty", frame.width,
                                   frame.height),
                       fmt::format("edits[{}]", i));
    }
    for (int y = change.low.y; y < change.low.y + change.height; ++y) {
      const auto row = cells.cells.begin() + static_cast<std::ptrdiff_t>(frame.index({change.low.x, y}));
      std::fill_n(row, change.width, change.blocked ? occupied_cell : free_cell);
    }
  }
  return cells;
}

/// Returns the obstacles after the edits.
Outcome<std::vector<std::vector<Vec2>>> edited(const PolygonMap& map, const std::vector<Edit>& edits) {
  std::vector<std::vector<Vec2>> obstacles = map.obstacles;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const Edit& edit = edits[i];
    if (edit.kind == Edit::Kind::add) {
      obstacles.push_back(edit.corners);
      continue;
    }
    if (edit.obstacle >= obstacles.size()) {
      return bad_input(
          fmt::format("there is no obstacle {}; the map has {}", edit.obstacle, obstacles.size()),
          fmt::format("edits[{}]", i));
    }
    obstacles[edit.obstacle] = edit.corners;  // no corners: removed
  }
  std::erase_if(obstacles, [](const auto& corners) { return corners.empty(); });
  return obstacles;
}

/// Makes the ground from scratch, without the original cells, which are not drawn here.
Outcome<PlanGround> made_anew(const GroundRequest& request) {
  const auto map = edited(*request.map, request.edits);
  if (!map) return pass_on(map);
  auto ground = plan_ground(map->shape, request.options);
  if (ground) ground->occupied = {};
  return ground;
}

}  // namespace

Outcome<std::vector<Edit>> edits_from_json(const Json& list, const KnownMap& map) {
  std::vector<Edit> edits;
  if (list.size() > most_edits)
    return bad_input("more than 10,000 edits; post the map as it is now", "edits");
  for (std::size_t i = 0; i < list.size(); ++i) {
    Fields fields(list[i], fmt::format("edits[{}]", i));
    edits.push_back(std::holds_alternative<MapCells>(map.shape) ? cell_edit(fields) : polygon_edit(fields));
    if (auto ok = fields.end(); !ok) return pass_on(ok);
  }
  return edits;
}

Outcome<KnownMap> edited(const KnownMap& map, const std::vector<Edit>& edits) {
  KnownMap after = map;
  if (auto* cells = std::get_if<MapCells>(&after.shape)) {
    auto occupancy = edited(*cells, edits);
    if (!occupancy) return pass_on(occupancy);
    cells->occupancy = std::move(*occupancy);
  } else {
    auto obstacles = edited(std::get<PolygonMap>(after.shape), edits);
    if (!obstacles) return pass_on(obstacles);
    std::get<PolygonMap>(after.shape).obstacles = std::move(*obstacles);
  }
  return after;
}

Outcome<PlanGround> GroundStore::make(const GroundRequest& request) {
  const bool grows = !request.options.needs_grid && !request.earlier_text.empty() &&
                     request.edits.back().kind == Edit::Kind::add && !request.edits.back().corners.empty();
  if (!grows) return made_anew(request);
  GroundRequest earlier = request;
  earlier.edits.pop_back();
  earlier.edits_text = std::exchange(earlier.earlier_text, {});
  auto ground = get(earlier);
  if (!ground) return pass_on(ground);
  auto more = (*ground)->polygons->with_obstacle(request.edits.back().corners);
  if (!more) return pass_on(more);
  PlanGround made = **ground;
  made.polygons = std::make_shared<const PolygonGround>(std::move(*more));
  return made;
}

Outcome<std::shared_ptr<const PlanGround>> GroundStore::get(const GroundRequest& request) {
  std::string name = fmt::format("{} {} {} {} {} {}", request.map->id, request.options.needs_grid,
                                 to_string(request.options.model), request.options.radius_m,
                                 request.options.grid.resolution_m, request.edits_text);
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(rows_.begin(), rows_.end(), [&](const CachedGround& row) { return row.name == name; });
    if (found != rows_.end()) {
      rows_.splice(rows_.begin(), rows_, found);
      return rows_.front().ground;
    }
  }
  auto made = make(request);
  if (!made) return pass_on(made);
  auto ground = std::make_shared<const PlanGround>(std::move(*made));
  const std::lock_guard lock(mutex_);
  rows_.push_front({std::move(name), ground});
  if (rows_.size() > most_grounds) rows_.pop_back();
  return ground;
}

}  // namespace outrider::server
