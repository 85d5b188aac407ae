#include "explore_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "choose/round_trip.hpp"
#include "support/grid_explorer.hpp"
#include "support/random_cases.hpp"
#include "support/random_rooms.hpp"

namespace outrider {
namespace {

constexpr RobotModel slow_robot{.radius_m = 0.1, .speed_mps = 0.25};

Grid<std::uint8_t> corridor(double length_m) {
  GridFrame frame;
  frame.resolution_m = 0.05;
  frame.width = static_cast<int>(length_m / frame.resolution_m) + 6;
  frame.height = 16;
  Grid<std::uint8_t> solid(frame, 1);
  for (int y = 3; y < 13; ++y) {
    for (int x = 3; x < frame.width - 3; ++x) solid[{x, y}] = 0;
  }
  return solid;
}

TEST(ExploreBound, IsTheWayToWhereTheEndComesIntoView) {
  const Grid<std::uint8_t> solid = corridor(20.0);
  const auto there = explore_bound(solid, {0.4, 0.4}, 3.0, slow_robot, {.return_home = false});
  const auto back = explore_bound(solid, {0.4, 0.4}, 3.0, slow_robot, {.return_home = true});
  ASSERT_TRUE(there && back);
  const double way_m = 20.15 - 0.1 - 3.0 - 0.4;  // to where the last place of the robot is in view
  EXPECT_LE(there->least_m, way_m);
  EXPECT_GT(there->least_m, 0.9 * way_m);
  EXPECT_LE(back->least_m, 2.0 * way_m);
  EXPECT_GT(back->least_m, 0.9 * 2.0 * way_m);
  EXPECT_NEAR(back->least_s, back->least_m / 0.25, 1e-9);
}

TEST(ExploreBound, IsNothingWhereAllIsInView) {
  const auto bound = explore_bound(corridor(2.0), {1.0, 0.4}, 3.5, slow_robot);
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->least_m, 0.0);
}

TEST(ExploreBound, RefusesABadStart) {
  const auto wall = explore_bound(corridor(2.0), {0.02, 0.02}, 3.5, slow_robot);
  ASSERT_FALSE(wall);
  EXPECT_EQ(wall.error().code, FaultCode::start_blocked);
  const auto outside = explore_bound(corridor(2.0), {-5.0, 0.0}, 3.5, slow_robot);
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().code, FaultCode::outside_map);
}

/// Every order of the stops.
TEST(ExploreBound, RoundsAreBestAmongAllOrders) {
  Rng rng(3);
  for (int n = 0; n < testing::cases(100); ++n) {
    RoundTrip round;
    round.count = 1 + rng.below(6);
    for (std::size_t i = 0; i < round.count; ++i) {
      round.out.push_back(rng.uniform());
      round.home.push_back(rng.uniform());
      for (std::size_t j = 0; j < round.count; ++j) round.between.push_back(rng.uniform());
    }
    std::vector<std::size_t> order(round.count);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<double> least(round.count, 1e9);
    do {
      double whole = round.out[order[0]] + round.home[order.back()];
      for (std::size_t i = 1; i < order.size(); ++i)
        whole += round.between[order[i - 1] * round.count + order[i]];
      least[order[0]] = std::min(least[order[0]], whole);
    } while (std::next_permutation(order.begin(), order.end()));
    const std::vector<double> found = wholes(round);
    for (std::size_t i = 0; i < round.count; ++i) ASSERT_NEAR(found[i], least[i], 1e-12);
  }
}

/// A walk from cell to cell, with the whole grid in view along rays of its own, until every cell that the
/// robot reaches was seen: greedy, and therefore no shorter than the best.
double greedy_walk_m(const Grid<std::uint8_t>& solid, Vec2 start, double range_m) {
  testing::GridExplorer eye{.truth = solid, .robot = slow_robot, .pose = {start, 0.0}};
  const auto free = [&](Cell c) {
    eye.pose.position = solid.frame.centre(c);
    return solid.contains(c) && eye.clearance_m() >= slow_robot.radius_m;
  };
  Grid<std::uint8_t> seen(solid.frame, 0);
  std::vector<Cell> reached{solid.frame.cell_at(start)};
  Grid<std::uint8_t> met(solid.frame, 0);
  met[reached[0]] = 1;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const Cell d : {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}}) {
      const Cell next{reached[i].x + d.x, reached[i].y + d.y};
      if (!solid.contains(next) || met[next] != 0 || !free(next)) continue;
      met[next] = 1;
      reached.push_back(next);
    }
  }
  const auto look = [&](Cell from) {
    for (int k = 0; k < 240; ++k) {
      const double most = testing::cast_ray(solid, solid.frame.centre(from), k * pi / 120.0, range_m);
      for (double r = 0.0; r < std::min(most, range_m); r += 0.04) {
        seen[solid.frame.cell_at(solid.frame.centre(from) + r * direction(k * pi / 120.0))] = 1;
      }
    }
  };
  Cell at = reached[0];
  double walked = 0.0;
  for (;;) {
    look(at);
    // Breadth first to the nearest cell that was not seen.
    std::map<std::pair<int, int>, Cell> from;
    std::vector<Cell> queue{at};
    from[{at.x, at.y}] = at;
    Cell goal = at;
    for (std::size_t i = 0; i < queue.size() && goal == at; ++i) {
      for (const Cell d : {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}}) {
        const Cell next{queue[i].x + d.x, queue[i].y + d.y};
        if (!solid.contains(next) || met[next] == 0 ||
            !from.emplace(std::pair(next.x, next.y), queue[i]).second)
          continue;
        queue.push_back(next);
        if (seen[next] == 0) {
          goal = next;
          break;
        }
      }
    }
    if (goal == at) return walked;
    Cell step = goal;
    while (!(from[{step.x, step.y}] == at)) step = from[{step.x, step.y}];
    at = step;
    walked += solid.frame.resolution_m;
  }
}

TEST(ExploreBound, NoWalkThatSeesAllIsShorter) {
  for (int n = 0; n < testing::cases(3); ++n) {
    Rng rng(static_cast<std::uint64_t>(n));
    const auto rooms = testing::random_rooms(rng, 3, 0.1);
    const auto bound =
        explore_bound(rooms.solid, rooms.start, 1.5, slow_robot, {.witnesses = 8, .return_home = false});
    ASSERT_TRUE(bound) << bound.error().sentence;
    EXPECT_LE(bound->least_m, greedy_walk_m(rooms.solid, rooms.start, 1.5)) << n;
  }
}

/// Rooms with walls of one cell.
Grid<std::uint8_t> thin_walls(Rng& rng) {
  GridFrame frame;
  frame.resolution_m = 0.1;
  frame.width = 34;
  frame.height = 23;
  Grid<std::uint8_t> solid(frame, 0);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) solid[{x, y}] = x % 11 == 0 || y % 11 == 0 ? 1 : 0;
  }
  const auto door = [&](Cell low, Cell along) {
    const int from = 1 + static_cast<int>(rng.below(5));
    for (int i = from; i < from + 5; ++i) solid[{low.x + i * along.x, low.y + i * along.y}] = 0;
  };
  for (int i = 0; i < 3; ++i) door({11 * i, 11}, {1, 0});
  door({11, rng.below(2) == 0 ? 0 : 11}, {0, 1});
  door({22, rng.below(2) == 0 ? 0 : 11}, {0, 1});
  return solid;
}

/// The shortest closed walk over centres of cells, by Dijkstra's algorithm over places and the witnesses seen
/// so far: the robot sees a witness from a centre within range of its centre with a free line between both.
double shortest_walk_m(const Grid<std::uint8_t>& solid, Vec2 start, double range_m,
                       const std::vector<Vec2>& witnesses) {
  const GridFrame& frame = solid.frame;
  testing::GridExplorer eye{.truth = solid, .robot = slow_robot, .pose = {start, 0.0}};
  std::vector<int> sees(frame.size(), -1);  // bits; -1 where it does not fit
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec2 at = eye.pose.position = frame.centre(frame.cell(i));
    if (solid.cells[i] != 0 || eye.clearance_m() < slow_robot.radius_m) continue;
    sees[i] = 0;
    for (std::size_t w = 0; w < witnesses.size(); ++w) {
      bool open = distance(at, witnesses[w]) <= range_m;
      for (int k = 0; open && k <= 400; ++k)
        open = solid[frame.cell_at(at + k / 400.0 * (witnesses[w] - at))] == 0;
      if (open) sees[i] |= 1 << w;
    }
  }
  const std::size_t sets = std::size_t{1} << witnesses.size();
  std::vector<double> least(frame.size() * sets, 1e9);
  std::map<std::pair<double, std::size_t>, bool> queue;
  const auto reach = [&](std::size_t cell, std::size_t set, double length) {
    if (sees[cell] < 0) return;
    set |= static_cast<std::size_t>(sees[cell]);
    if (length >= least[cell * sets + set]) return;
    least[cell * sets + set] = length;
    queue[{length, cell * sets + set}] = true;
  };
  const std::size_t from = frame.index(frame.cell_at(start));
  reach(from, 0, 0.0);
  while (!queue.empty()) {
    const auto [length, state] = queue.begin()->first;
    queue.erase(queue.begin());
    if (length > least[state]) continue;
    const Cell at = frame.cell(state / sets);
    if (state == from * sets + sets - 1) return length;
    for (int k = 0; k < 9; ++k) {
      const Cell next{at.x + k % 3 - 1, at.y + k / 3 - 1};
      if (solid.contains(next))
        reach(frame.index(next), state % sets,
              length + frame.resolution_m * std::hypot(next.x - at.x, next.y - at.y));
    }
  }
  return 1e9;
}

TEST(ExploreBound, IsNoMoreThanTheShortestClosedWalkPastThinWalls) {
  for (int n = 0; n < testing::cases(12); ++n) {
    Rng rng = Rng(77).child(static_cast<std::uint64_t>(n));
    const Grid<std::uint8_t> solid = thin_walls(rng);
    const Vec2 start{0.55, 0.55};
    const double range_m = rng.uniform(0.6, 1.5);
    const auto blunt = explore_bound(solid, start, range_m, slow_robot, {.witnesses = 8});
    const auto exact =
        explore_bound(solid, start, range_m, slow_robot, {.witnesses = 8, .exact_cells = true});
    ASSERT_TRUE(blunt && exact);
    EXPECT_GE(exact->least_m, blunt->least_m) << n;  // which sees through these walls
    const double shortest_m = shortest_walk_m(solid, start, range_m, exact->witnesses);
    ASSERT_LT(shortest_m, 1e8);
    EXPECT_LE(exact->least_m, shortest_m) << n;
    EXPECT_GT(exact->least_m, 0.4 * shortest_m) << n;
  }
}

}  // namespace
}  // namespace outrider
