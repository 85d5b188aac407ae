#include "outrider/path/from_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "support/costly_cases.hpp"

namespace outrider {
namespace {

/// A yard of turned boxes, posts and thin walls, some smaller than a cell.
CollisionMap random_yard(Rng& rng) {
  std::vector<RoundedPolygon> obstacles;
  for (int i = 0; i < 14; ++i) {
    const Vec2 centre{rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0)};
    const Vec2 along = direction(rng.uniform(0.0, 2.0 * pi));
    const Vec2 a = rng.uniform(0.02, 1.2) * along, b = rng.uniform(0.01, 0.5) * perpendicular(along);
    switch (rng.below(3)) {
      case 0:
        obstacles.push_back(
            {convex_hull({centre - a - b, centre + a - b, centre + a + b, centre - a + b}), 0.0});
        break;
      case 1: obstacles.push_back({{centre}, rng.uniform(0.01, 0.4)}); break;
      default: obstacles.push_back({{centre - a, centre + a}, rng.uniform(0.0, 0.1)}); break;
    }
  }
  return {Box2{{-5.0, -5.0}, {5.0, 5.0}}, obstacles};
}

class WorldGrid : public ::testing::TestWithParam<GridModel> {};
INSTANTIATE_TEST_SUITE_P(Models, WorldGrid, ::testing::Values(GridModel::cells, GridModel::corners),
                         [](const auto& model) { return std::string(to_string(model.param)); });

TEST_P(WorldGrid, EveryPathIsFreeForTheDisk) {
  Rng rng = Rng(21).child("yards");
  Workspace workspace;
  int found = 0;
  const int yards = testing::costly_cases(15);
  for (int i = 0; i < yards; ++i) {
    const CollisionMap yard = random_yard(rng);
    const double radius = i % 5 == 0 ? 0.0 : rng.uniform(0.0, 0.4);
    const auto grid = grid_from_world(yard, radius, GetParam(), {.resolution_m = rng.uniform(0.07, 0.4)});
    ASSERT_TRUE(grid.has_value());
    const auto shared = std::make_shared<const GridMap>(*grid);
    for (int k = 0; k < 6; ++k) {
      const auto point = [&] { return Vec2{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)}; };
      const Problem problem{shared, point(), point()};
      for (const PathPlanner& row : path_planners()) {
        const auto plan = row.configure().plan(problem, {}, workspace);
        if (!plan) continue;
        ++found;
        const auto verdict = check(*plan, yard, radius);
        ASSERT_TRUE(verdict.has_value())
            << "yard " << i << " " << row.name << ": " << verdict.error().sentence;
        ASSERT_TRUE(check(*plan, problem).has_value());
        for (const Vec2 p : plan->waypoints) ASSERT_GE(yard.clearance(p, 1.0), radius - 1e-9);
      }
    }
  }
  EXPECT_GT(found, 3 * yards);
}

/// Free cells are free at every sampled point; blocked ones have a point that is too near, and so lie
/// within radius + sqrt(2) resolution of an obstacle.
TEST(BlockedForDisk, IsExactCellByCell) {
  Rng rng = Rng(22).child("cells");
  for (int i = 0; i < testing::costly_cases(10); ++i) {
    const CollisionMap yard = random_yard(rng);
    const double radius = rng.uniform(0.0, 0.3), resolution = rng.uniform(0.1, 0.4);
    const auto blocked = blocked_for_disk(yard, radius, {.resolution_m = resolution});
    ASSERT_TRUE(blocked.has_value());
    for (std::size_t c = 0; c < blocked->cells.size(); ++c) {
      const Cell cell = blocked->frame.cell(c);
      double least = std::numeric_limits<double>::infinity();
      constexpr int samples = 8;
      for (int s = 0; s <= samples * samples + 2 * samples; ++s) {
        const Vec2 share{s % (samples + 1) / double{samples}, s / (samples + 1) / double{samples}};
        least = std::min(least, yard.clearance(blocked->frame.corner(cell) + resolution * share, 2.0));
      }
      if (blocked->cells[c] == 0) {
        ASSERT_GE(least, radius - 2e-9) << "yard " << i;
      } else {
        ASSERT_LT(least, radius + resolution / samples)
            << "yard " << i;  // clearance changes by at most the step
      }
    }
  }
}

TEST(BlockedForDisk, RefusesNumbersThatMakeNoGrid) {
  const CollisionMap yard(Box2{{0.0, 0.0}, {20.0, 20.0}}, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(blocked_for_disk(yard, nan, {}).has_value());
  EXPECT_FALSE(blocked_for_disk(yard, -1.0, {}).has_value());
  for (const double resolution : {0.0, -1.0, nan, 1e-300, 1e-6}) {
    const auto answer = blocked_for_disk(yard, 0.2, {.resolution_m = resolution});
    ASSERT_FALSE(answer.has_value()) << resolution;
    EXPECT_EQ(answer.error().where, "resolution");
  }
  EXPECT_FALSE(blocked_for_disk(yard, 0.2, {.resolution_m = 1.0, .most_cells = 399}).has_value());
  EXPECT_TRUE(blocked_for_disk(yard, 0.2, {.resolution_m = 1.0, .most_cells = 400}).has_value());
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(blocked_for_disk(CollisionMap(Box2{{0, 0}, {1e9, 1e9}}, {}), 0.2, {}).has_value());
  EXPECT_FALSE(blocked_for_disk(yard, infinity, {}).has_value());
  const auto wide = blocked_for_disk(yard, 50.0, {});
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(std::count(wide->cells.begin(), wide->cells.end(), 0), 0);
}

}  // namespace
}  // namespace outrider
