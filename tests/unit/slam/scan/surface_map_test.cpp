// Matching against rooms whose walls are known, exhaustive search and finite differences.
#include "scan/surface_map.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr Pose2 in_the_room{{2.2, 2.0}, 0.4};

Surface surface_at(const Pose2& pose, Rng& rng, double noise_m = 0.01) {
  testing::Finder finder;
  finder.noise_m = noise_m;
  return surface_of(testing::scan_from(testing::furnished_room(), pose, finder, rng), {}, 30.0);
}

TEST(Surface, LiesOnTheWallsAndFacesTheLaser) {
  Rng rng(1);
  const auto walls = testing::furnished_room();
  const Surface surface = surface_at(in_the_room, rng, 0.0);
  ASSERT_GT(surface.size(), 100U);
  std::size_t straight = 0;
  for (const SurfacePoint& p : surface) {
    const Vec2 place = in_the_room * p.position;
    double nearest = 1e9;
    for (const testing::Wall& wall : walls) {
      const Vec2 side = wall.b - wall.a;
      const double along = std::clamp(dot(place - wall.a, side) / squared_norm(side), 0.0, 1.0);
      nearest = std::min(nearest, distance(place, wall.a + along * side));
    }
    EXPECT_LT(nearest, 0.05);
    EXPECT_LE(dot(p.normal, p.position), 0.0);
    const Vec2 normal = rotated(in_the_room.heading_rad, p.normal);
    straight += std::max(std::abs(normal.x), std::abs(normal.y)) > 0.999 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(straight), 0.85 * static_cast<double>(surface.size()))
      << "all walls are square";
}

TEST(SurfaceMap, FindsThePoseFromAnyOffset) {
  Rng rng(2);
  const Surface there = surface_at(in_the_room, rng);
  const SurfaceMap map(std::vector<SurfaceMap::Part>{{&there, in_the_room, 0}});
  for (int trial = 0; trial < testing::cases(10); ++trial) {
    const Pose2 truth{in_the_room.position + testing::random_point(rng, 0.3),
                      in_the_room.heading_rad + rng.uniform(-1.0, 1.0)};
    const Surface here = surface_at(truth, rng);
    const Pose2 guess{truth.position + testing::random_point(rng, 0.45),
                      truth.heading_rad + rng.uniform(-0.35, 0.35)};
    const auto found = map.find(here, {guess, 0.5, 0.4}, 0.3);
    ASSERT_TRUE(found);
    EXPECT_LT(distance(found->pose.position, truth.position), 0.08);
    const Fit fit = map.refine(here, found->pose, {found->pose, Eigen::Matrix3d::Zero()});
    EXPECT_LT(distance(fit.pose.position, truth.position), 0.015);
    EXPECT_LT(std::abs(fit.pose.heading_rad - truth.heading_rad), 0.008);
    EXPECT_GT(fit.share, 0.8);
  }
}

TEST(SurfaceMap, TheSearchLosesNothingToAnExhaustiveOne) {
  Rng rng(3);
  const Surface there = surface_at(in_the_room, rng);
  const SurfaceMap map(std::vector<SurfaceMap::Part>{{&there, in_the_room, 0}});
  constexpr double cell_m = 0.05;
  for (int trial = 0; trial < testing::cases(2); ++trial) {
    const Surface here = thinned(surface_at({{2.0, 2.3}, rng.uniform(-3.0, 3.0)}, rng), 60);
    const Pose2 guess{{rng.uniform(1.8, 2.6), rng.uniform(1.6, 2.4)}, rng.uniform(-0.5, 0.5)};
    for (const double least : {0.0, 0.2}) {
      const MatchWindow window{guess, 0.9, 0.0, 0.2, 0.1};
      const auto found = map.find(here, window, least);
      double best = least;
      for (int y = -18; y <= 18; ++y) {
        for (int x = -18; x <= 18; ++x) {
          const Vec2 off = cell_m * Vec2{double(x), double(y)};
          const auto alone = map.find(here, {{guess.position + off, guess.heading_rad}, 0.0, 0.0}, -1.0);
          ASSERT_TRUE(alone);
          best = std::max(best, alone->score - 0.01 * squared_norm(off) / (0.2 * 0.2));
        }
      }
      ASSERT_EQ(found.has_value(), best > least);
      EXPECT_NEAR(found ? found->score : best, best, 1e-9);
    }
  }
}

TEST(SurfaceMap, TheGradientIsThatOfFiniteDifferences) {
  Rng rng(4);
  testing::Finder finder;
  finder.noise_m = 0.0;
  finder.most_m = 20.0;
  const auto walls = testing::box_walls({-6, -5}, {6, 5});
  const Surface there = surface_of(testing::scan_from(walls, {}, finder, rng), {}, 30.0);
  const SurfaceMap map(std::vector<SurfaceMap::Part>{{&there, {}, 0}});
  Surface here;  // without the corners, where a point may go from one wall to the other
  for (const SurfacePoint& p : there) {
    if (std::abs(std::abs(p.position.x) - 6.0) + std::abs(std::abs(p.position.y) - 5.0) > 0.6)
      here.push_back(p);
  }
  for (int trial = 0; trial < 20; ++trial) {
    const Pose2 pose{testing::random_point(rng, 0.04), rng.uniform(-0.004, 0.004)};
    const auto cost = [&](double dx, double dy, double turn) {
      return map.equations(here, {pose.position + Vec2{dx, dy}, pose.heading_rad + turn}).cost;
    };
    constexpr double h = 1e-5;
    const Eigen::Vector3d slope = {(cost(h, 0, 0) - cost(-h, 0, 0)) / (2 * h),
                                   (cost(0, h, 0) - cost(0, -h, 0)) / (2 * h),
                                   (cost(0, 0, h) - cost(0, 0, -h)) / (2 * h)};
    const MatchEquations at = map.equations(here, pose);
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_NEAR(at.gradient[i], slope[i], 0.02 * std::abs(slope[i]) + 5.0) << i;
  }
}

TEST(SurfaceMap, ACorridorLeavesItsDirectionToThePrior) {
  Rng rng(5);
  const auto walls = testing::box_walls({-30, -1}, {30, 1});
  const Surface there = surface_of(testing::scan_from(walls, {}, {}, rng), {}, 30.0);
  const Surface here = surface_of(testing::scan_from(walls, {{0.1, 0.05}, 0.02}, {}, rng), {}, 30.0);
  const SurfaceMap map(std::vector<SurfaceMap::Part>{{&there, {}, 0}});
  const Pose2 odometry{{0.11, 0.0}, 0.0};
  const Fit fit = map.refine(here, odometry, {odometry, 1e4 * Eigen::Matrix3d::Identity()});
  EXPECT_NEAR(fit.pose.position.x, 0.11, 0.01);
  EXPECT_NEAR(fit.pose.position.y, 0.05, 0.01);
  EXPECT_NEAR(fit.pose.heading_rad, 0.02, 0.005);
  EXPECT_LT(fit.information(0, 0), 0.1 * fit.information(1, 1));
}

TEST(SurfaceMap, NothingMatchesNothing) {
  const SurfaceMap map(std::vector<SurfaceMap::Part>{});
  EXPECT_FALSE(map.find({}, {{}, 1.0, 1.0}, 0.1));
  const Surface point = {{{1.0, 0.0}, {-1.0, 0.0}}};
  EXPECT_FALSE(map.find(point, {{}, 1.0, 1.0}, 0.1));
  EXPECT_EQ(map.refine(point, {}, {}).share, 0.0);
}

}  // namespace
}  // namespace outrider
