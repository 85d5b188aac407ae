#include "yard/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/path/routes/routes.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::firing_map_of;
using testing::random_guard_problem;

/// Returns for each cell the metres from one of them.
std::vector<double> ways_from(const Lattice& lattice, const FiringMap& firing_map, std::size_t cell) {
  Field field(firing_map.frame.size(), endless);
  field[cell] = 0;
  lattice.lower(field, 1);
  std::vector<double> ways;
  for (const std::uint16_t units : field) ways.push_back(units * lattice.unit_m());
  return ways;
}

TEST(Lattice, IsWithinFourPercentOfStraightLinesOnOpenGround) {
  GuardProblem problem;
  problem.world.bounds = {{-3, -3}, {3, 3}};
  problem.start = {{0, 0}, 0};
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.1});
  const Lattice lattice(firing_map, problem.robot.radius_m);
  const std::size_t from = firing_map.frame.index({12, 20});
  const auto ways = ways_from(lattice, firing_map, from);
  for (std::size_t c = 0; c < firing_map.frame.size(); ++c) {
    if (firing_map.reachable[c] == 0) continue;
    const double straight = distance(firing_map.frame.centre(firing_map.frame.cell(from)),
                                     firing_map.frame.centre(firing_map.frame.cell(c)));
    EXPECT_LE(ways[c], straight + 1e-9);
    EXPECT_GE(ways[c], 0.9645 * straight);
  }
}

TEST(Lattice, RunsAlongAYardThatIsOneCellWide) {
  GuardProblem problem;
  problem.world.bounds = {{-0.3, -3}, {0.3, 3}};
  problem.start = {{0, 0}, 0};
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.65});
  ASSERT_EQ(firing_map.frame.width, 1);
  const Lattice lattice(firing_map, problem.robot.radius_m);
  const auto ways = ways_from(lattice, firing_map, 1);
  for (std::size_t c = 1; c < ways.size(); ++c) {
    EXPECT_NEAR(ways[c], 0.65 * static_cast<double>(c - 1) / std::sqrt(1.04), 1e-9);
  }
}

/// Routes are free ways, so none is shorter than the lattice says; nor is a smaller robot's, all the less.
TEST(Lattice, IsNeverAboveAFreeWay) {
  Rng rng(84);
  double sum = 0.0;
  int pairs = 0;
  int bent = 0;
  for (int i = 0; i < cases(30); ++i) {
    GuardProblem problem = random_guard_problem(rng, 4 + rng.below(20), 1, 2.5);
    problem.robot.radius_m = rng.uniform(0.02, 0.3);
    problem.gun.tip_forward_m = problem.gun.tip_up_m = 0.0;  // within the smallest of these robots
    const FiringMap firing_map = firing_map_of(problem, {.resolution_m = rng.uniform(0.05, 0.4)});
    const Lattice lattice(firing_map, problem.robot.radius_m);
    std::vector<std::size_t> cells;
    std::vector<Vec2> places;
    for (int k = 0; k < 100; ++k) {
      const std::size_t cell = rng.below(firing_map.frame.size());
      if (firing_map.reachable[cell] == 0 || cells.size() >= 16) continue;
      cells.push_back(cell);
      places.push_back(firing_map.frame.centre(firing_map.frame.cell(cell)));
    }
    const auto routes = routes_between(firing_map.ground, problem.robot, places, {}, {radians(10.0)}, {});
    ASSERT_TRUE(routes.has_value()) << routes.error().sentence;
    for (std::size_t a = 0; a < cells.size(); ++a) {
      const auto ways = ways_from(lattice, firing_map, cells[a]);
      for (std::size_t b = 0; b < cells.size(); ++b) {
        const auto points = routes->waypoints(a, b);
        if (a == b || points.size() < 2) continue;
        double length = 0.0;
        for (std::size_t k = 1; k < points.size(); ++k) length += distance(points[k - 1], points[k]);
        ASSERT_LE(ways[cells[b]], length + 1e-9) << "yard " << i << ", " << a << " to " << b;
        sum += length > 0.0 ? ways[cells[b]] / length : 1.0;
        bent += points.size() > 2 ? 1 : 0;
        ++pairs;
      }
    }
  }
  EXPECT_GT(bent, 100);
  EXPECT_GT(sum / pairs, 0.93) << "the lattice goes through walls";
}

/// Spreading finds the least value over a chain of moves, as relaxing all moves until nothing changes does.
TEST(Lattice, SpreadsManySourcesAtOnce) {
  Rng rng(85);
  for (int i = 0; i < cases(10); ++i) {
    const GuardProblem problem = random_guard_problem(rng, 12, 1, 2.0);
    const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
    const Lattice lattice(firing_map, problem.robot.radius_m);
    Field field(firing_map.frame.size(), endless);
    for (int k = 0; k < 5; ++k) field[rng.below(field.size())] = static_cast<std::uint16_t>(rng.below(90));
    Field expected = field;
    for (std::size_t source = 0; source < field.size(); ++source) {
      if (field[source] == endless) continue;
      Field alone(field.size(), endless);
      alone[source] = field[source];
      lattice.lower(alone, 2);
      for (std::size_t c = 0; c < alone.size(); ++c) expected[c] = std::min(expected[c], alone[c]);
    }
    lattice.lower(field, 2);
    EXPECT_EQ(field, expected);
  }
}

}  // namespace
}  // namespace outrider
