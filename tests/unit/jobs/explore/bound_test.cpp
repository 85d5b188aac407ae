#include "outrider/jobs/explore/bound.hpp"

#include <gtest/gtest.h>

#include <map>

#include "round_trip.hpp"
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

}  // namespace
}  // namespace outrider
