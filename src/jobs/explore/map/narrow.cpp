#include "map/narrow.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

#include "map/reach.hpp"
#include "outrider/control/nearby.hpp"

namespace outrider {
namespace {

/// visit(next, length) for the neighbours of a cell off the edge that pass no corner: good(cell) must be true
/// of each, and of both cells beside a diagonal move.
template <class Good, class Visit>
void for_each_move(std::uint32_t cell, int width, Good good, Visit visit) {
  for (std::size_t i = 0; i < 8; ++i) {
    const Cell d = grid_moves[i];
    const auto moved = [&](int x, int y) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(cell) + std::int64_t{y} * width + x);
    };
    const std::uint32_t next = moved(d.x, d.y);
    if (good(next) && (i < 4 || (good(moved(d.x, 0)) && good(moved(0, d.y))))) visit(next, i < 4 ? 5 : 7);
  }
}

/// Marks what the robot can drive to.
std::vector<std::uint32_t> flood_drivable(const TraversabilityGrid& ground, Vec2 from, WidestWays& ways) {
  const auto is_free = [&](Cell c) {
    return !ground.blocked(static_cast<std::uint32_t>(ground.frame().index(c)));
  };
  const auto start = nearest_cell(ground.frame(), from, snap_m, is_free);
  if (!start) return {};
  std::vector<std::uint32_t> open{static_cast<std::uint32_t>(ground.frame().index(*start))};
  ways.room_m[open[0]] = WidestWays::drivable;
  for (std::size_t i = 0; i < open.size(); ++i) {
    for_each_move(
        open[i], ground.frame().width, [&](std::uint32_t cell) { return !ground.blocked(cell); },
        [&](std::uint32_t next, int) {
          if (ways.room_m[next] != 0.0F) return;
          ways.room_m[next] = WidestWays::drivable;
          open.push_back(next);
        });
  }
  return open;
}

struct Reached {
  float room_m = 0.0F;
  std::uint32_t length = 0;  // off the drivable ground
  std::uint32_t cell = 0;

  /// Returns true if the other one comes first.
  bool operator<(const Reached& other) const {
    return std::tuple(room_m, other.length, other.cell) < std::tuple(other.room_m, length, cell);
  }
};

}  // namespace

std::uint32_t WidestWays::roomiest(const std::vector<std::uint32_t>& cells) const {
  return *std::ranges::max_element(cells, {}, [&](std::uint32_t cell) { return room_m[cell]; });
}

std::vector<std::uint32_t> WidestWays::way_to(std::uint32_t cell) const {
  std::vector<std::uint32_t> way{cell};
  while (before[way.back()] != none) way.push_back(before[way.back()]);
  std::ranges::reverse(way);
  return way;
}

WidestWays widest_ways(const TraversabilityGrid& ground, Vec2 from, bool past_touches, double least_room_m) {
  const GridFrame& frame = ground.frame();
  WidestWays ways{std::vector<float>(frame.size(), 0.0F),
                  std::vector<std::uint32_t>(frame.size(), WidestWays::none)};
  const auto good = [&](std::uint32_t cell) {
    return ground.known().cells[cell] == free_cell && (past_touches || !ground.touched(cell));
  };
  std::vector<float> clearance(frame.size(), -1.0F);
  std::vector<std::uint32_t> length(frame.size(), 0);
  std::priority_queue<Reached> queue;
  const auto extend = [&](const Reached& here) {
    for_each_move(here.cell, frame.width, good, [&](std::uint32_t next, int step) {
      if (ways.room_m[next] == WidestWays::drivable) return;
      if (clearance[next] < 0.0F) clearance[next] = static_cast<float>(ground.clearance_m(frame.cell(next)));
      const Reached reached{std::min(here.room_m, clearance[next]),
                            here.length + static_cast<std::uint32_t>(step), next};
      if (reached.room_m < static_cast<float>(least_room_m)) return;
      if (!(Reached{ways.room_m[next], length[next], next} < reached)) return;
      ways.room_m[next] = reached.room_m;
      length[next] = reached.length;
      ways.before[next] = here.cell;
      queue.push(reached);
    });
  };
  for (const std::uint32_t cell : flood_drivable(ground, from, ways)) extend({WidestWays::drivable, 0, cell});
  while (!queue.empty()) {
    const Reached here = queue.top();
    queue.pop();
    if (ways.room_m[here.cell] == here.room_m && length[here.cell] == here.length) extend(here);
  }
  return ways;
}

Bottleneck bottleneck_of(const TraversabilityGrid& ground, const std::vector<std::uint32_t>& way) {
  const GridFrame& frame = ground.frame();
  std::uint32_t narrowest = way.front();
  double least_m = std::numeric_limits<double>::infinity();
  for (const std::uint32_t cell : way) {
    const double room_m = ground.clearance_m(frame.cell(cell));
    if (room_m >= least_m) continue;
    least_m = room_m;
    narrowest = cell;
  }
  // The middle of a gap may lie between the centres of cells.
  const Vec2 centre = frame.centre(frame.cell(narrowest));
  const Nearby around(ground.known(), centre, least_m + 3.0 * frame.resolution_m);
  Bottleneck found{centre, 2.0 * least_m};
  for (int k = 0; k < 9; ++k) {
    const Vec2 at = centre + 0.5 * frame.resolution_m * Vec2{k % 3 - 1.0, k / 3 - 1.0};
    found.width_m =
        std::max(found.width_m, 2.0 * std::min(around.clearance(at), least_m + frame.resolution_m));
  }
  return found;
}

}  // namespace outrider
