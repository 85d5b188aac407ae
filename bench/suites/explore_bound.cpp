#include "explore_bound.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

#include "choose/round_trip.hpp"
#include "map/rays.hpp"
#include "outrider/path/grid/from_occupancy.hpp"
#include "outrider/path/problem.hpp"
#include "tour_bound.hpp"

namespace outrider {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eight_moves_ratio = 1.0824;
constexpr std::size_t most_exact = 11;  // of witnesses and the start

/// Cells all whose points are nearer than the radius to something solid.
Grid<std::uint8_t> surely_blocked(const Grid<std::uint8_t>& solid, double radius_m) {
  const double radius = radius_m / solid.frame.resolution_m - std::numbers::sqrt2 / 2.0;  // of centres
  const int reach = std::max(0, static_cast<int>(radius + 1.0));
  std::vector<Cell> near{{0, 0}};
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const double across = std::max(0.0, std::abs(x) - 0.5), up = std::max(0.0, std::abs(y) - 0.5);
      if (std::hypot(across, up) < radius) near.push_back({x, y});
    }
  }
  Grid<std::uint8_t> blocked(solid.frame, 0);
  for (int y = 0; y < solid.frame.height; ++y) {
    for (int x = 0; x < solid.frame.width; ++x) {
      if (solid[{x, y}] == 0) continue;
      for (const Cell offset : near) {
        const Cell at{x + offset.x, y + offset.y};
        if (solid.contains(at)) blocked[at] = 1;
      }
    }
  }
  return blocked;
}

/// Solid cells with none but solid ones around them.
Grid<std::uint8_t> deep(const Grid<std::uint8_t>& solid) {
  Grid<std::uint8_t> inside(solid.frame, 0);
  for (int y = 0; y < solid.frame.height; ++y) {
    for (int x = 0; x < solid.frame.width; ++x) {
      bool all = true;
      for (int k = 0; k < 9 && all; ++k) {
        const Cell at{x + k % 3 - 1, y + k / 3 - 1};
        all = !solid.contains(at) || solid[at] != 0;
      }
      inside[{x, y}] = all ? 1 : 0;
    }
  }
  return inside;
}

struct Scene {
  const Grid<std::uint8_t>& solid;
  bool exact;  ///< solid cells are solid to their borders
  Grid<std::uint8_t> inside;
  GridMap corners;  ///< where its centre may be
  double range;     ///< cells
};

/// Returns true if some point of a cell may see some point of another past solid cells. A line between them
/// stays, in each column along its longer side, within `around` rows of the line between the centres; so it
/// meets only free cells that hang together through these columns.
bool strip_is_open(const Grid<std::uint8_t>& solid, Cell a, Cell b) {
  const bool upright = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  const int across = upright ? b.x - a.x : b.y - a.y, along = upright ? b.y - a.y : b.x - a.x;
  const int step = along < 0 ? -1 : 1, count = std::abs(along);
  if (count == 0) return true;
  const double slope = static_cast<double>(across) / count;
  const double around = 0.5 + std::abs(slope);  // at the middle of a column
  const auto lowest = [&](int column) {
    return static_cast<int>(std::ceil(slope * column - around - 0.5 - 1e-9));
  };
  unsigned open = 0;  // bit i: row lowest(column) + i of the column is reached
  for (int column = 0; column <= count; ++column) {
    const int low = lowest(column), high = static_cast<int>(std::floor(slope * column + around + 0.5 + 1e-9));
    unsigned free = 0;
    for (int row = low; row <= high; ++row) {
      const Cell at = upright ? Cell{a.x + row, a.y + step * column} : Cell{a.x + step * column, a.y + row};
      if (solid.contains(at) && solid[at] == 0) free |= 1U << static_cast<unsigned>(row - low);
    }
    if (column == 0) {
      open = 1U << static_cast<unsigned>(-low);
    } else {
      const int shift = low - lowest(column - 1);
      open = (open << 1U) | open | (open >> 1U);
      open = shift >= 0 ? open >> static_cast<unsigned>(shift) : open << static_cast<unsigned>(-shift);
    }
    open &= free;
    for (unsigned before = 0; before != open;) {
      before = open;
      open |= ((open << 1U) | (open >> 1U)) & free;
    }
    if (open == 0) return false;
  }
  return (open >> static_cast<unsigned>(across - lowest(count)) & 1U) != 0;
}

/// The places from where a cell may be seen.
std::vector<Cell> viewers(const Scene& scene, Cell seen) {
  const int reach = static_cast<int>(scene.range + std::numbers::sqrt2) + 1;
  std::vector<Cell> cells;
  for (int y = seen.y - reach; y <= seen.y + reach; ++y) {
    for (int x = seen.x - reach; x <= seen.x + reach; ++x) {
      if (scene.corners.blocked({x, y})) continue;
      if (std::hypot(x - seen.x, y - seen.y) > scene.range + std::numbers::sqrt2) continue;
      bool clear = !scene.exact || strip_is_open(scene.solid, seen, {x, y});
      if (!scene.exact) {
        walk_ray(seen, {x, y}, [&](Cell at) {
          clear = scene.inside[at] == 0;
          return clear && !(at == Cell{x, y});
        });
      }
      if (clear) cells.push_back({x, y});
    }
  }
  return cells;
}

/// Returns the distances from the corners of some cells to all others along the eight moves, in cells.
std::vector<double> distances(const GridMap& ground, const std::vector<Cell>& from) {
  using QueueEntry = std::pair<double, std::uint32_t>;
  std::vector<double> least(ground.moves.size(), infinity);
  std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t vertex, double away) {
    if (away >= least[vertex]) return;
    least[vertex] = away;
    queue.emplace(away, vertex);
  };
  for (const Cell cell : from) {
    for (int k = 0; k < 4; ++k) reach(ground.index({cell.x + k % 2, cell.y + k / 2}), 0.0);
  }
  while (!queue.empty()) {
    const auto [away, vertex] = queue.top();
    queue.pop();
    if (away > least[vertex]) continue;
    const Cell at = ground.at(vertex);
    for (unsigned left = ground.moves[vertex]; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      reach(ground.index({at.x + grid_moves[i].x, at.y + grid_moves[i].y}),
            away + (i < 4 ? 1.0 : std::numbers::sqrt2));
    }
  }
  return least;
}

/// A lower bound between points of the cells from which the distances were counted and of those, in cells.
double least_between(const GridMap& ground, const std::vector<double>& away, const std::vector<Cell>& to) {
  double least = infinity;
  for (const Cell cell : to) {
    for (int k = 0; k < 4; ++k) least = std::min(least, away[ground.index({cell.x + k % 2, cell.y + k / 2})]);
  }
  return std::max(0.0, least / eight_moves_ratio - std::numbers::sqrt2);
}

/// The cells that the robot reaches whatever the approximations, as vertices.
std::vector<Cell> surely_reached(const GridMap& ground, Cell start) {
  std::vector<std::uint8_t> met(ground.moves.size(), 0);
  std::vector<Cell> cells{start};
  met[ground.index(start)] = 1;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell at = cells[i];
    for (unsigned left = ground.moves[ground.index(at)]; left != 0; left &= left - 1) {
      const Cell step = grid_moves[static_cast<std::size_t>(std::countr_zero(left))];
      const Cell next{at.x + step.x, at.y + step.y};
      if (std::exchange(met[ground.index(next)], std::uint8_t{1}) == 0) cells.push_back(next);
    }
  }
  return cells;
}

/// Witnesses, the sets that see them, and the distances between those; the start is the first of all.
struct Witnesses {
  std::vector<Cell> cells;
  std::vector<std::vector<Cell>> seen_from;
  std::vector<std::vector<double>> between;
};

Witnesses farthest_first(const Scene& scene, Cell start, const std::vector<Cell>& reached, int most) {
  Witnesses all;
  std::vector<double> nearest(scene.corners.moves.size(), infinity);
  for (Cell next = start;;) {
    all.cells.push_back(next);
    all.seen_from.push_back(next == start && all.cells.size() == 1 ? std::vector<Cell>{start}
                                                                   : viewers(scene, next));
    const std::vector<double> away = distances(scene.corners, all.seen_from.back());
    all.between.emplace_back();
    for (const auto& cells : all.seen_from) {
      all.between.back().push_back(least_between(scene.corners, away, cells));
    }
    if (static_cast<int>(all.cells.size()) > most) return all;
    for (std::size_t i = 0; i < away.size(); ++i) nearest[i] = std::min(nearest[i], away[i]);
    double farthest = 0.0;
    for (const Cell cell : reached) {
      const double here = nearest[scene.corners.index(cell)];
      if (here <= farthest) continue;
      farthest = here;
      next = cell;
    }
    if (farthest <= 0.0) return all;
  }
}

/// Raises the bound of a closed path by the rounds through more witnesses than dynamic programming takes.
void raise(const Scene& scene, const Witnesses& all, ExploreBound& bound) {
  StopDistances distances;
  for (std::size_t i = 0; i < all.cells.size(); ++i) {
    distances.emplace_back();
    for (std::size_t j = 0; j < all.cells.size(); ++j)
      distances[i].push_back(all.between[std::max(i, j)][std::min(i, j)]);
  }
  for (std::size_t count = 4; count <= all.cells.size(); count += 4) {
    std::vector<std::size_t> stops(count);
    std::iota(stops.begin(), stops.end(), std::size_t{0});
    const double least_m = scene.solid.frame.resolution_m * best_tour_bound(distances, stops);
    if (least_m <= bound.least_m) continue;
    bound.least_m = least_m;
    bound.witnesses.clear();
    for (std::size_t i = 1; i < stops.size(); ++i)
      bound.witnesses.push_back(scene.solid.frame.centre(all.cells[stops[i]]));
  }
}

}  // namespace

Outcome<ExploreBound> explore_bound(const Grid<std::uint8_t>& solid, Vec2 start, double range_m,
                                    const RobotModel& robot, const ExploreBoundOptions& options) {
  auto sure = grid_from_occupancy(solid, robot.radius_m, GridModel::cells);
  if (!sure) return pass_on(sure);
  const auto ground = std::make_shared<const GridMap>(*std::move(sure));
  const auto query = grid_query({ground, start, start});
  if (!query) return pass_on(query);
  auto corners = GridMap::of(surely_blocked(solid, robot.radius_m), GridModel::corners);
  if (!corners) return pass_on(corners);
  const double resolution = solid.frame.resolution_m;
  const Scene scene{solid, options.exact_cells, deep(solid), *std::move(corners), range_m / resolution};
  const Witnesses all = farthest_first(scene, query->start, surely_reached(*ground, query->start),
                                       std::clamp(options.witnesses, 1, 64));
  ExploreBound bound;
  // More witnesses may make the round shorter, since sets are nearer to one another than their points.
  for (std::size_t count = 1; count < std::min(all.cells.size(), most_exact); ++count) {
    RoundTrip round;
    round.count = count;
    for (std::size_t i = 0; i < count; ++i) {
      round.out.push_back(all.between[i + 1][0]);
      round.home.push_back(options.return_home ? all.between[i + 1][0] : 0.0);
      for (std::size_t j = 0; j < count; ++j) {
        round.between.push_back(all.between[std::max(i, j) + 1][std::min(i, j) + 1]);
      }
    }
    const std::vector<double> lengths = wholes(round);
    const double least_m = resolution * *std::min_element(lengths.begin(), lengths.end());
    if (least_m <= bound.least_m) continue;
    bound.least_m = least_m;
    bound.witnesses.clear();
    for (std::size_t i = 1; i <= count; ++i) bound.witnesses.push_back(solid.frame.centre(all.cells[i]));
  }
  if (options.return_home) raise(scene, all, bound);
  bound.least_s = bound.least_m / robot.speed_mps;
  return bound;
}

}  // namespace outrider
