#include "known_maps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "explore_maps.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/grid/from_occupancy.hpp"
#include "outrider/world/blocks.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider::bench {
namespace {

constexpr double walls_m = 0.5;     // walls and boxes
constexpr double end_room_m = 0.3;  // around start and goal
constexpr double least_way_m = 2.0;
constexpr double apart_m = 0.8;   // boxes from start and goal
constexpr double widest_m = 1.2;  // narrow place that is closed
constexpr double spare_m = 0.1;   // beside the footprint, with which there surely is a way
constexpr std::uint64_t unknown_every = 5, closed_every = 3;

/// Makes what is reached from the edge of a map unknown, unless nothing else is free.
void leave_out_outside(Grid<std::uint8_t>& occupancy) {
  Grid<std::uint8_t> outside(occupancy.frame, 0);
  const auto [width, height] = std::pair(occupancy.frame.width, occupancy.frame.height);
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    const Cell cell = occupancy.frame.cell(i);
    const bool edge = cell.x == 0 || cell.y == 0 || cell.x + 1 == width || cell.y + 1 == height;
    if (edge && occupancy.cells[i] == free_cell && outside.cells[i] == 0) part_of(occupancy, i, outside);
  }
  const auto is_inside = [&](std::size_t i) {
    return occupancy.cells[i] == free_cell && outside.cells[i] == 0;
  };
  std::size_t inside = 0, free = 0;
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    inside += is_inside(i);
    free += occupancy.cells[i] == free_cell;
  }
  if (4 * inside < free) return;
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    if (outside.cells[i] != 0) occupancy.cells[i] = unknown_cell;
  }
}

Outcome<BenchMap> load_bench_map(const std::string& path) {
  auto loaded = load_map(path);
  if (!loaded) return pass_on(loaded);
  auto* const cells = std::get_if<MapCells>(&loaded->shape);
  if (cells == nullptr) return bad_input("is no map of cells; give one of map_server", path);
  BenchMap map{std::filesystem::path(path).stem().string(), std::move(cells->occupancy)};
  leave_out_outside(map.occupancy);
  return map;
}

/// Fills whole cells about a place.
void fill_cells(Grid<std::uint8_t>& cells, Vec2 low, Vec2 high) {
  const Cell first = cells.frame.cell_at(low), last = cells.frame.cell_at(high);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      if (cells.contains({x, y})) cells[{x, y}] = occupied_cell;
    }
  }
}

bool is_connected(const Grid<std::uint8_t>& solid, double radius_m, Vec2 from, Vec2 to) {
  const auto blocked = radius_m > 0.0 ? inflated(solid, radius_m) : Outcome<Grid<std::uint8_t>>(solid);
  const Cell start = solid.frame.cell_at(from), goal = solid.frame.cell_at(to);
  if (!blocked || (*blocked)[start] != 0 || (*blocked)[goal] != 0) return false;
  Grid<std::uint8_t> met(solid.frame, 0);
  part_of(*blocked, solid.frame.index(start), met);
  return met[goal] != 0;
}

/// Returns points on a short way of a disk; empty if there is none.
std::vector<Vec2> short_way(const Grid<std::uint8_t>& solid, double radius_m, Vec2 from, Vec2 to) {
  auto ground = grid_from_occupancy(solid, radius_m, GridModel::cells);
  if (!ground) return {};
  Problem problem;
  problem.grid = std::make_shared<const GridMap>(std::move(*ground));
  problem.start = from;
  problem.goal = to;
  const auto plan = plan_path(problem, "theta_star");
  if (!plan) return {};
  std::vector<Vec2> way{from};
  for (const Vec2 corner : plan->waypoints) {
    const Vec2 last = way.back();
    const int pieces = std::max(1, static_cast<int>(distance(last, corner) / 0.1));
    for (int i = 1; i <= pieces; ++i) way.push_back(last + static_cast<double>(i) / pieces * (corner - last));
  }
  return way;
}

/// Returns the distance from a place to the nearest cell that is not free, at most `most_m`.
double room_at(const Grid<std::uint8_t>& solid, Vec2 place, double most_m) {
  double least = most_m;
  const Vec2 reach{most_m, most_m};
  const Cell low = solid.frame.cell_at(place - reach), high = solid.frame.cell_at(place + reach);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!solid.contains({x, y}) || solid[{x, y}] != free_cell)
        least = std::min(least, distance(place, solid.frame.centre({x, y})));
    }
  }
  return least;
}

/// Closes the narrowest place of a way, if it is narrow. Returns true if it did.
bool close_door(Grid<std::uint8_t>& solid, const std::vector<Vec2>& way) {
  const double most_m = 0.5 * widest_m;
  double least = most_m;
  std::optional<Vec2> narrowest;
  for (const Vec2 place : way) {
    if (distance(place, way.front()) < apart_m + most_m || distance(place, way.back()) < apart_m + most_m)
      continue;
    const double room = room_at(solid, place, most_m);
    if (room >= least) continue;
    least = room;
    narrowest = place;
  }
  if (!narrowest) return false;
  const Vec2 half{most_m, most_m};
  fill_cells(solid, *narrowest - half, *narrowest + half);
  return true;
}

/// Puts boxes on and beside the way.
void put_boxes(Grid<std::uint8_t>& solid, const std::vector<Vec2>& way, Rng& rng) {
  const auto boxes = rng.below(4);
  for (std::uint64_t i = 0; i < boxes; ++i) {
    const Vec2 on = way[rng.below(way.size())];
    const double aside = rng.uniform(-0.6, 0.6), along = rng.uniform(-0.6, 0.6);
    const Vec2 place = on + Vec2{aside, along}, half{rng.uniform(0.05, 0.3), rng.uniform(0.05, 0.3)};
    const double clear_m = apart_m + std::max(half.x, half.y);
    if (distance(place, way.front()) < clear_m || distance(place, way.back()) < clear_m) continue;
    fill_cells(solid, place - half, place + half);
  }
}

World world_of_cells(const Grid<std::uint8_t>& solid) {
  World world;
  world.name = "map";
  world.solids = blocks(solid, 0.0, walls_m);
  world.bounds = solid.frame.bounds();
  return world;
}

}  // namespace

Outcome<std::vector<BenchMap>> known_maps(const std::vector<std::string>& files, const std::string& folder) {
  std::vector<std::string> paths = files;
  std::vector<BenchMap> maps;
  if (!folder.empty()) {
    std::error_code error;
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
      if (entry.path().extension() == ".yaml" &&
          load_map(entry.path().string()).has_value())  // others are no maps
        found.push_back(entry.path().string());
    }
    if (error) return bad_input("no such folder", folder);
    std::ranges::sort(found);
    paths.insert(paths.end(), found.begin(), found.end());
  }
  for (const std::string& path : paths) {
    auto map = load_bench_map(path);
    if (!map) return pass_on(map);
    maps.push_back(std::move(*map));
  }
  if (folder.empty()) return maps;
  if (auto grids = published_explore_maps(folder)) {  // a folder may have none
    for (ExploreMap& grid : *grids) maps.push_back({std::move(grid.name), std::move(grid.solid)});
  }
  return maps;
}

std::optional<MapCase> draw_case(const BenchMap& map, const Footprint& footprint, std::uint64_t number) {
  const std::vector<std::size_t> part = largest_part(map.occupancy, end_room_m);
  if (part.empty()) return std::nullopt;
  Rng rng = Rng(number).child(map.name);
  const GridFrame& frame = map.occupancy.frame;
  const auto draw = [&] { return frame.centre(frame.cell(part[rng.below(part.size())])); };
  MapCase drawn;
  drawn.start = {draw(), 0.0};
  drawn.goal = drawn.start.position;
  for (int i = 0; i < 100 && distance(drawn.start.position, drawn.goal) < least_way_m; ++i)
    drawn.goal = draw();
  drawn.start.heading_rad = rng.uniform(-pi, pi);
  const auto way = short_way(map.occupancy, footprint.outer_m(), drawn.start.position, drawn.goal);
  if (way.empty() || distance(drawn.start.position, drawn.goal) < least_way_m) return std::nullopt;
  for (std::size_t i = 1; i < way.size(); ++i) drawn.way_m += distance(way[i - 1], way[i]);
  drawn.start_unknown = number % unknown_every == 0;
  drawn.people = static_cast<std::int64_t>(rng.below(4));
  Grid<std::uint8_t> solid = map.occupancy;
  drawn.closed = number % closed_every == 0 && close_door(solid, way);
  put_boxes(solid, way, rng);
  drawn.world = world_of_cells(solid);
  const Vec2 from = drawn.start.position;
  drawn.surely_a_way = is_connected(solid, footprint.outer_m() + spare_m, from, drawn.goal);
  drawn.surely_none = !is_connected(solid, 0.0, from, drawn.goal);
  return drawn;
}

}  // namespace outrider::bench
