#include "outrider/jobs/pursue/target_forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "outrider/core/options.hpp"

namespace outrider {
namespace {

/// Waiting first, then the eight moves in the order of rows.
constexpr std::array<Cell, 9> moves = {
    {{0, 0}, {-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

constexpr Cell moved(Cell c, Cell by) { return {c.x + by.x, c.y + by.y}; }

/// The cells where the target may be: all of the map, but walls only if it was seen on one.
class Floor {
 public:
  explicit Floor(const TargetSeen& seen)
      : map_(seen.map), walks_walls_(std::ranges::any_of(seen.cells, [&](Cell c) { return map_.wall(c); })) {}

  [[nodiscard]] bool holds(Cell c) const {
    return map_.costs->contains(c) && (walks_walls_ || !map_.wall(c));
  }

 private:
  const PursuitProblem& map_;
  bool walks_walls_;
};

/// Cells a second, over the last seconds seen.
Vec2 velocity(std::span<const Cell> cells) {
  constexpr std::size_t most_seconds = 8;
  const std::size_t seconds = std::min(most_seconds, cells.size() - 1);
  if (seconds == 0) return {};
  const Cell from = cells[cells.size() - 1 - seconds], to = cells.back();
  const double share = 1.0 / static_cast<double>(seconds);
  return {share * (to.x - from.x), share * (to.y - from.y)};
}

std::vector<Cell> stay(const TargetSeen& seen, std::size_t seconds) {
  return std::vector<Cell>(seconds, seen.cells.back());
}

/// Straight on; it stays where the floor ends.
std::vector<Cell> straight_on(const TargetSeen& seen, std::size_t seconds) {
  const Floor floor(seen);
  const Vec2 v = velocity(seen.cells);
  const Cell last = seen.cells.back();
  std::vector<Cell> cells;
  cells.reserve(seconds);
  Cell at = last;
  for (bool on = true; cells.size() < seconds;) {
    const auto s = static_cast<double>(cells.size() + 1);
    const Cell next{last.x + static_cast<int>(std::lround(s * v.x)),
                    last.y + static_cast<int>(std::lround(s * v.y))};
    on = on && floor.holds(next);
    if (on) at = next;
    cells.push_back(at);
  }
  return cells;
}

/// To the neighbour it has visited most, each visit of the forecast taken off; where it has been nowhere,
/// straight on.
std::vector<Cell> along_visits(const TargetSeen& seen, std::size_t seconds) {
  const Floor floor(seen);
  const GridFrame& frame = seen.map.costs->frame;
  std::map<std::size_t, int> visits;
  for (const Cell cell : seen.cells) ++visits[frame.index(cell)];
  const Vec2 v = velocity(seen.cells);
  Cell way{static_cast<int>(std::lround(v.x)), static_cast<int>(std::lround(v.y))};
  std::vector<Cell> cells;
  cells.reserve(seconds);
  for (Cell at = seen.cells.back(); cells.size() < seconds; cells.push_back(at)) {
    --visits[frame.index(at)];
    Cell best = floor.holds(moved(at, way)) ? way : Cell{};
    int most = 0;
    for (const Cell move : moves) {
      const Cell next = moved(at, move);
      if (move == Cell{} || !floor.holds(next)) continue;
      const auto found = visits.find(frame.index(next));
      const int count = found == visits.end() ? 0 : found->second;
      if (count < most || (count == most && (count == 0 || move != way))) continue;
      most = count;
      best = move;
    }
    if (best != Cell{}) way = best;
    at = moved(at, best);
  }
  return cells;
}

/// King's moves from the robot over free cells; the largest int where it cannot come.
Grid<int> moves_from(const PursuitProblem& map, Cell robot) {
  constexpr int never = std::numeric_limits<int>::max();
  Grid<int> steps(map.costs->frame, never);
  std::vector<Cell> queue{robot};
  steps[robot] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Cell at = queue[head];
    for (const Cell move : moves) {
      const Cell next = moved(at, move);
      if (!steps.contains(next) || map.wall(next) || steps[next] != never) continue;
      steps[next] = steps[at] + 1;
      queue.push_back(next);
    }
  }
  return steps;
}

/// To the neighbour farthest from the robot.
std::vector<Cell> away(const TargetSeen& seen, std::size_t seconds) {
  const Floor floor(seen);
  const Grid<int> steps = moves_from(seen.map, seen.robot);
  std::vector<Cell> cells;
  cells.reserve(seconds);
  for (Cell at = seen.cells.back(); cells.size() < seconds; cells.push_back(at)) {
    Cell best = at;
    for (const Cell move : moves) {
      const Cell next = moved(at, move);
      if (floor.holds(next) && steps[next] > steps[best]) best = next;
    }
    at = best;
  }
  return cells;
}

}  // namespace

const std::vector<TargetForecast>& target_forecasts() {
  static const std::vector<TargetForecast> all = {
      {"last_velocity", "straight on at the mean velocity of its last 8 seconds", straight_on},
      {"visit_map", "back along the cells it has visited most, a map learned as it is seen", along_visits},
      {"evade", "an adversary that goes where the robot is farthest", away},
      {"stay", "it stands where it was seen last", stay},
  };
  return all;
}

Outcome<TargetForecast> find_target_forecast(std::string_view name) {
  return find_row(target_forecasts(), "forecast", name, "forecast");
}

}  // namespace outrider
