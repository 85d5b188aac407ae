#include "outrider/slam/map/occupancy_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "outrider/world/grid_ray.hpp"

namespace outrider {
namespace {

constexpr double odds_unit = 1.0 / 1024.0;
constexpr double most_odds = 15.0;  // so that the sum of two fits 16 bits
constexpr int block_cells = 128;
constexpr double most_cells = 1e8;

std::int16_t quantised(double odds) {
  return static_cast<std::int16_t>(std::lround(std::clamp(odds, -most_odds, most_odds) / odds_unit));
}

struct Beam {
  LatticePoint end;
  bool hits = false;
};

/// The beams with a reading, on the lattice; not usable if one leaves it.
struct Beams {
  LatticePoint start;
  std::vector<Beam> all;
  Cell low, high;  ///< bounds of the cells they cross
  bool usable = false;
};

Beams beams_of(const Pose2& world_T_laser, const LaserScan& scan, double resolution_m) {
  Beams beams;
  const auto cells = [&](Vec2 p) { return (1.0 / resolution_m) * p; };
  const auto inside = [](Vec2 p) {
    return std::abs(p.x) < most_lattice_cells && std::abs(p.y) < most_lattice_cells;
  };
  const Vec2 start = cells(world_T_laser.position);
  if (!inside(start) || !std::isfinite(world_T_laser.heading_rad)) return beams;
  beams.start = lattice_point(start);
  beams.low = beams.high = beams.start.cell();
  beams.all.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    const bool hits = range_m >= scan.least_m && range_m <= scan.most_m;
    if (!hits && !(range_m > scan.most_m)) continue;
    const double bearing = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    const Vec2 way = std::min(range_m, scan.most_m) * direction(world_T_laser.heading_rad + bearing);
    const Vec2 end = start + cells(way);
    if (!inside(end)) return beams;
    beams.all.push_back({lattice_point(end), hits});
    const Cell cell = beams.all.back().end.cell();
    beams.low = {std::min(beams.low.x, cell.x), std::min(beams.low.y, cell.y)};
    beams.high = {std::max(beams.high.x, cell.x), std::max(beams.high.y, cell.y)};
  }
  beams.usable = !beams.all.empty();
  return beams;
}

int block_below(int cell) { return (cell >= 0 ? cell : cell - block_cells + 1) / block_cells * block_cells; }

}  // namespace

std::vector<Option> describe(OccupancyMapOptions& o) {
  return {{"resolution", "m", 0.01, 100, "side of a cell", &o.resolution_m},
          {"hit_odds", "", 0.05, most_odds, "log odds that the end of a beam adds", &o.hit_odds},
          {"miss_odds", "", 0.01, most_odds, "log odds that a passing beam takes", &o.miss_odds},
          {"most_odds", "", 0.01, most_odds, "bound of the log odds to both sides", &o.most_odds},
          {"free_below", "", -most_odds, 0, "log odds below which a cell is free", &o.free_below},
          {"occupied_above", "", 0, most_odds, "log odds above which a cell is occupied", &o.occupied_above}};
}

Status check(const OccupancyMapOptions& options) {
  const auto refused = [&](double value, const char* leaves, const char* expected, const char* key) {
    return bad_input(fmt::format("'{:g}' leaves no cell {}; expected {} occupancy.most_odds, which is {:g}",
                                 value, leaves, expected, options.most_odds),
                     key);
  };
  const std::int16_t most = quantised(options.most_odds);
  if (quantised(options.occupied_above) >= most)
    return refused(options.occupied_above, "occupied", "less than", "occupancy.occupied_above");
  if (quantised(options.free_below) <= -most)
    return refused(options.free_below, "free", "more than the negative of", "occupancy.free_below");
  return {};
}

OccupancyMap::OccupancyMap(const OccupancyMapOptions& options) : options_(options) {
  occupancy_.frame.resolution_m = options.resolution_m;
}

double OccupancyMap::log_odds(Cell cell) const {
  return occupancy_.contains(cell) ? odds_unit * odds_[frame().index(cell)] : 0.0;
}

/// Enlarges the map to contain the cells. Returns false if it would become too large.
bool OccupancyMap::cover(Cell low, Cell high, bool& grown) {
  const GridFrame old = frame();
  Cell from{block_below(low.x), block_below(low.y)};
  Cell to{block_below(high.x) + block_cells, block_below(high.y) + block_cells};
  if (old.size() > 0) {
    from = {std::min(from.x, low_.x), std::min(from.y, low_.y)};
    to = {std::max(to.x, low_.x + old.width), std::max(to.y, low_.y + old.height)};
  }
  if (static_cast<double>(to.x - from.x) * static_cast<double>(to.y - from.y) > most_cells) return false;
  GridFrame next = old;
  next.width = to.x - from.x;
  next.height = to.y - from.y;
  next.origin = {from.x * options_.resolution_m, from.y * options_.resolution_m};
  grown = !(next == old);
  if (!grown) return true;
  const Cell by{low_.x - from.x, low_.y - from.y};
  odds_ = moved_cells(odds_, old, next, by, std::int16_t{0});
  occupancy_.cells =
      moved_cells(occupancy_.cells, old, next, by, static_cast<std::uint8_t>(Occupancy::unknown_cell));
  occupancy_.frame = next;
  change_.assign(next.size(), 0);
  low_ = from;
  return true;
}

/// Adds the changes to the odds of a run of cells, sixteen at a time without a branch, and records the cells
/// whose occupancy changed.
void OccupancyMap::apply(std::size_t begin, std::size_t end, std::vector<std::size_t>& changed) {
  constexpr std::size_t lanes = 16;
  const std::int16_t most = quantised(options_.most_odds);
  const std::int16_t free = quantised(options_.free_below), occupied = quantised(options_.occupied_above);
  const auto run = [&](std::size_t first, std::size_t count) {
    std::array<std::uint8_t, lanes> next;
    for (std::size_t k = 0; k < count; ++k) {
      const auto sum = static_cast<std::int16_t>(odds_[first + k] + change_[first + k]);
      const std::int16_t odds = std::clamp<std::int16_t>(sum, static_cast<std::int16_t>(-most), most);
      odds_[first + k] = odds;
      change_[first + k] = 0;
      next[k] = odds < free       ? Occupancy::free_cell
                : odds > occupied ? Occupancy::occupied_cell
                                  : Occupancy::unknown_cell;
    }
    if (std::equal(next.begin(), next.begin() + static_cast<std::ptrdiff_t>(count),
                   &occupancy_.cells[first])) {
      return;
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (occupancy_.cells[first + k] == next[k]) continue;
      occupancy_.cells[first + k] = next[k];
      changed.push_back(first + k);
    }
  };
  for (; begin + lanes <= end; begin += lanes) {
    const auto* changes = &change_[begin];
    std::int16_t any = 0;
    for (std::size_t k = 0; k < lanes; ++k) any = static_cast<std::int16_t>(any | changes[k]);
    if (any != 0) run(begin, lanes);
  }
  if (begin < end) run(begin, end - begin);
}

MapUpdate OccupancyMap::insert(const Pose2& world_T_laser, const LaserScan& scan) {
  MapUpdate update;
  if (!check(scan)) return update;
  const Beams beams = beams_of(world_T_laser, scan, options_.resolution_m);
  if (!beams.usable || !cover(beams.low, beams.high, update.redrawn)) return update;
  const GridFrame& where = frame();
  const auto index = [&](Cell cell) { return where.index({cell.x - low_.x, cell.y - low_.y}); };
  const auto miss = static_cast<std::int16_t>(-quantised(options_.miss_odds));
  const std::int16_t hit = quantised(options_.hit_odds);
  for (const Beam& beam : beams.all) {
    cross_cells(beams.start, beam.end, [&](Cell cell) { change_[index(cell)] = miss; });
  }
  for (const Beam& beam : beams.all) {
    if (beam.hits) change_[index(beam.end.cell())] = hit;
  }
  for (int y = beams.low.y; y <= beams.high.y; ++y) {
    apply(index({beams.low.x, y}), index({beams.high.x, y}) + 1, update.cells);
  }
  if (update.redrawn) update.cells.clear();
  return update;
}

}  // namespace outrider
