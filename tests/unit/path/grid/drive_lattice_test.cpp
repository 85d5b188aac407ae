#include "outrider/path/grid/drive_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/path/routes/routes.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using Field = DriveLattice::Field;

constexpr std::uint16_t endless = DriveLattice::endless;
constexpr double height_m = 0.8;

/// A yard of 2 x half by 2 y half metres, as a grid.
struct Yard {
  Yard(Vec2 half, double resolution_m, std::vector<Solid> solids = {})
      : frame{-1.0 * half, resolution_m, cells(half.x, resolution_m), cells(half.y, resolution_m)} {
    World world;
    world.bounds = {-1.0 * half, half};
    world.solids = std::move(solids);
    ground = CollisionMap::of(world, height_m);
    for (std::size_t c = 0; c < frame.size(); ++c)
      clearance_m.push_back(static_cast<float>(ground->clearance(frame.centre(frame.cell(c)), 1.0)));
  }

  static int cells(double half_m, double resolution_m) {
    return std::max(1, static_cast<int>(2.0 * half_m / resolution_m));
  }
  [[nodiscard]] DriveLattice lattice(double radius_m) const { return {frame, clearance_m, radius_m}; }

  GridFrame frame;
  std::optional<CollisionMap> ground;
  std::vector<float> clearance_m;
};

/// A box, a post or a thin wall.
Solid random_solid(Rng& rng, double half_m) {
  const Vec3 where{rng.uniform(-half_m, half_m), rng.uniform(-half_m, half_m), 0.3};
  const Pose3 pose{where, Rotation::from_rpy(0.0, 0.0, rng.uniform(-pi, pi))};
  const double a = rng.uniform(0.05, 0.35), b = rng.uniform(0.05, 0.35);
  switch (rng.below(3)) {
    case 0: return {"box", pose, BoxShape{{a, b, 0.3}}};
    case 1: return {"post", pose, CylinderShape{a, 0.3}};
    default: return {"wall", pose, BoxShape{{0.002, 0.6, 0.3}}};
  }
}

Yard random_yard(Rng& rng, std::size_t solids, double half_m, double resolution_m) {
  std::vector<Solid> all;
  for (std::size_t i = 0; i < solids; ++i) all.push_back(random_solid(rng, half_m));
  return {{half_m, half_m}, resolution_m, std::move(all)};
}

/// Returns for each cell the metres from one of them.
std::vector<double> ways_from(const DriveLattice& lattice, const GridFrame& frame, std::size_t cell) {
  Field field(frame.size(), endless);
  field[cell] = 0;
  lattice.lower(field, 1);
  std::vector<double> ways;
  for (const std::uint16_t units : field) ways.push_back(units * lattice.unit_m());
  return ways;
}

TEST(DriveLattice, IsWithinFourPercentOfStraightLinesOnOpenGround) {
  const Yard yard({3.0, 3.0}, 0.1);
  const GridFrame& frame = yard.frame;
  const double radius_m = RobotModel{}.radius_m;
  const std::size_t from = frame.index({12, 20});
  const auto ways = ways_from(yard.lattice(radius_m), frame, from);
  for (std::size_t c = 0; c < frame.size(); ++c) {
    if (yard.clearance_m[c] < radius_m) continue;
    const double straight = distance(frame.centre(frame.cell(from)), frame.centre(frame.cell(c)));
    EXPECT_LE(ways[c], straight + 1e-9);
    EXPECT_GE(ways[c], 0.9645 * straight);
  }
}

TEST(DriveLattice, RunsAlongAYardThatIsOneCellWide) {
  const Yard yard({0.3, 3.0}, 0.65);
  ASSERT_EQ(yard.frame.width, 1);
  const auto ways = ways_from(yard.lattice(RobotModel{}.radius_m), yard.frame, 1);
  for (std::size_t c = 1; c < ways.size(); ++c) {
    EXPECT_NEAR(ways[c], 0.65 * static_cast<double>(c - 1) / std::sqrt(1.04), 1e-9);
  }
}

/// Routes are free ways, so none is shorter than the lattice says; nor is a smaller robot's, all the less.
TEST(DriveLattice, IsNeverAboveAFreeWay) {
  Rng rng(84);
  double sum = 0.0;
  int pairs = 0;
  int bent = 0;
  for (int i = 0; i < cases(30); ++i) {
    const Yard yard = random_yard(rng, 4 + rng.below(20), 2.5, rng.uniform(0.05, 0.4));
    const GridFrame& frame = yard.frame;
    RobotModel robot;
    robot.radius_m = rng.uniform(0.02, 0.3);
    const DriveLattice lattice = yard.lattice(robot.radius_m);
    std::vector<std::size_t> cells;
    std::vector<Vec2> places;
    for (int k = 0; k < 100; ++k) {
      const std::size_t cell = rng.below(frame.size());
      if (yard.clearance_m[cell] < robot.radius_m + 1e-6 || cells.size() >= 16) continue;
      cells.push_back(cell);
      places.push_back(frame.centre(frame.cell(cell)));
    }
    const auto routes = routes_between(*yard.ground, robot, places, {}, {radians(10.0)}, {});
    ASSERT_TRUE(routes.has_value()) << routes.error().sentence;
    for (std::size_t a = 0; a < cells.size(); ++a) {
      const auto ways = ways_from(lattice, frame, cells[a]);
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
TEST(DriveLattice, SpreadsManySourcesAtOnce) {
  Rng rng(85);
  for (int i = 0; i < cases(10); ++i) {
    const Yard yard = random_yard(rng, 12, 2.0, 0.25);
    const DriveLattice lattice = yard.lattice(RobotModel{}.radius_m);
    Field field(yard.frame.size(), endless);
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
