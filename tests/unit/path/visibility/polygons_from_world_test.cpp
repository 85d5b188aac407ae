#include "outrider/path/visibility/polygons_from_world.hpp"

#include <gtest/gtest.h>

#include "outrider/path/check.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

TEST(PolygonsFromWorld, PathsAreFreeAmongTheExactShapesAndShortestAmongAllButTheTightest) {
  Rng rng = Rng(51).child("worlds");
  Workspace workspace;
  int joined = 0;
  for (int i = 0; i < testing::cases(200); ++i) {
    std::vector<RoundedPolygon> obstacles;
    for (std::uint64_t k = rng.below(8); k > 0; --k) {
      RoundedPolygon obstacle = testing::random_rounded_polygon(rng, 3.0);
      if (obstacle.core.size() < 3 && obstacle.radius_m < 0.01) obstacle.radius_m = 0.2;
      obstacles.push_back(obstacle);
    }
    const CollisionMap world({{-6.0, -6.0}, {6.0, 6.0}}, obstacles);
    const double radius_m = rng.uniform(0.05, 0.5);
    auto polygons = polygons_from_world(world, radius_m);
    ASSERT_TRUE(polygons.has_value()) << polygons.error().sentence;
    for (int k = 0; k < 100; ++k) {
      const Vec2 p = testing::random_point(rng, 6.0);
      const double clear = world.clearance(p, 2.0);
      if (polygons->point_free(p)) {
        EXPECT_GE(clear, radius_m - 2.0 * contact_m);
      } else {
        EXPECT_LT(clear, radius_m + 0.004 * 6.0);  // no obstacle is rounder than 6 m
      }
    }
    const Problem problem{nullptr, testing::random_point(rng, 5.0), testing::random_point(rng, 5.0),
                          std::make_shared<const PolygonGround>(std::move(*polygons))};
    const auto plan = visibility_graph_reduced(problem, {true}, {}, workspace);
    if (!plan || plan->waypoint_error_m > 0.0) continue;
    ++joined;
    // segment_free allows a contact of 1e-9 m, the polygons' judge twice as much.
    const auto verdict = check(*plan, world, radius_m - 2.0 * contact_m);
    EXPECT_TRUE(verdict.has_value()) << "world " << i << ": " << verdict.error().sentence;
  }
  EXPECT_GT(joined, 50);
}

}  // namespace
}  // namespace outrider
