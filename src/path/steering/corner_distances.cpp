#include "corner_distances.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "../grid/octile.hpp"

namespace outrider {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
const double most_ratio = 1.0 / std::cos(std::numbers::pi / 8.0);

/// The legal moves at a corner, a bit for each in the order of grid_moves. The index has a bit for each free
/// cell: 0 north-east, 1 north-west, 2 south-west, 3 south-east of the corner. A pinch has none: no path
/// passes it.
constexpr std::array<std::uint8_t, 16> moves_by_free_cells = [] {
  std::array<std::uint8_t, 16> moves{};
  for (unsigned free = 0; free < 16; ++free) {
    const bool ne = (free & 1U) != 0, nw = (free & 2U) != 0, sw = (free & 4U) != 0, se = (free & 8U) != 0;
    if (ne == sw && nw == se && ne != nw) continue;
    const std::array<bool, 8> legal = {ne || se, ne || nw, nw || sw, sw || se, ne, nw, sw, se};
    for (unsigned i = 0; i < 8; ++i) {
      if (legal[i]) moves[free] = static_cast<std::uint8_t>(moves[free] | (1U << i));
    }
  }
  return moves;
}();

Cell cell_of(Vec2 p) { return {static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))}; }

std::array<Cell, 4> corners_of(Cell c) {
  return {{{c.x, c.y}, {c.x + 1, c.y}, {c.x, c.y + 1}, {c.x + 1, c.y + 1}}};
}

double apart(Vec2 p, Cell corner) { return distance(p, Vec2{double(corner.x), double(corner.y)}); }

}  // namespace

unsigned CornerDistances::moves_of(Cell v) const {
  const std::uint32_t ne = ground_->index(v), se = ground_->index({v.x, v.y - 1});
  const auto free = [&](std::uint32_t at) { return (ground_->marks[at] & GridMap::blocked_bit) == 0; };
  const unsigned pattern =
      (free(ne) ? 1U : 0U) | (free(ne - 1) ? 2U : 0U) | (free(se - 1) ? 4U : 0U) | (free(se) ? 8U : 0U);
  return moves_by_free_cells[pattern];
}

Status CornerDistances::begin(const GridMap& ground, Vec2 goal, Vec2 start, const std::stop_token& stop) {
  ground_ = &ground;
  goal_ = goal;
  goal_cell_ = cell_of(goal);
  target_ = cell_of(start);
  stride_ = ground.frame.width + 1;
  stop_ = stop;
  goal_offset_ = infinite;
  labels_.begin(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(ground.frame.height + 1));
  queue_.begin(octile_distance(goal_cell_, target_).value());
  for (const Cell corner : corners_of(goal_cell_)) {
    if (moves_of(corner) == 0) continue;
    relax(corner, apart(goal, corner));
    goal_offset_ = std::min(goal_offset_, apart(goal, corner));
  }
  if (std::isfinite(at(start)) || stop.stop_requested()) return {};
  return fault(
      FaultCode::no_path,
      "nothing joins the start and the goal, even for the largest disk in the robot, turning in place");
}

void CornerDistances::relax(Cell v, double distance) {
  const State s = index(v);
  if (labels_.known(s) && (labels_.closed(s) || !(distance < labels_.g(s)))) return;
  labels_.open(s, s, distance);
  queue_.push(distance + octile_distance(v, target_).value(), distance, s);
}

double CornerDistances::settled(Cell corner) {
  const State asked = index(corner);
  if (labels_.known(asked) && labels_.closed(asked)) return labels_.g(asked);
  QueueEntry entry;
  for (unsigned step = 0; queue_.pop(entry); ++step) {
    if (labels_.closed(entry.state)) continue;
    if (step % 1024 == 1023 && stop_.stop_requested()) return infinite;
    labels_.close(entry.state);
    const double g = labels_.g(entry.state);
    const int at = static_cast<int>(entry.state);
    const Cell v{at % stride_, at / stride_};
    for (unsigned left = moves_of(v); left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      relax({v.x + grid_moves[i].x, v.y + grid_moves[i].y}, g + (i < 4 ? 1.0 : std::numbers::sqrt2));
    }
    if (entry.state == asked) return g;
  }
  return infinite;
}

double CornerDistances::at(Vec2 p) {
  const Cell cell = cell_of(p);
  double least = cell == goal_cell_ ? distance(p, goal_) : infinite;
  for (const Cell corner : corners_of(cell)) {
    if (moves_of(corner) != 0) least = std::min(least, apart(p, corner) + settled(corner));
  }
  return least;
}

double CornerDistances::lower_bound(Vec2 p) {
  double most = distance(p, goal_);
  for (const Cell corner : corners_of(cell_of(p))) {
    if (moves_of(corner) == 0) continue;
    most = std::max(most, (settled(corner) - goal_offset_) / most_ratio - goal_offset_ - apart(p, corner));
  }
  return most;
}

}  // namespace outrider
