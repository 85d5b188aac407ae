#include "outrider/world/upright.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

/// The cut of a plane through the solid is the slice again.
TEST(Upright, StandsAsItWasCut) {
  const std::vector<std::vector<Vec2>> all = {{{0, 1}, {2, 3}},
                                              {{1, 1}, {1, 4}},
                                              {{0, 0}, {2, 1}, {1.5, 2}, {-0.5, 1}},
                                              {{0, 0}, {2, 0}, {3, 1}, {1, 3}, {0, 2}}};
  for (const std::vector<Vec2>& corners : all) {
    const Solid solid = upright(corners, "it", 1.0, 1.5);
    EXPECT_TRUE(footprint(solid, 0.0, 0.99).empty());
    EXPECT_TRUE(footprint(solid, 1.51, 3.0).empty());
    const auto gap = [&](Vec2 p, double low_m, double high_m) {
      double nearest = 1e9;
      for (const auto& piece : footprint(solid, low_m, high_m)) {
        nearest = std::min(nearest, signed_distance(p, piece));
      }
      return nearest;
    };
    const RoundedPolygon whole{corners, 0.0};
    for (double x = -1.0; x < 4.0; x += 0.13) {
      for (double y = -1.0; y < 4.0; y += 0.17) {
        const double expected = signed_distance(Vec2{x, y}, whole);
        if (expected > 0.0) {
          EXPECT_NEAR(gap({x, y}, 1.18, 1.18), expected, 1e-9);
          EXPECT_NEAR(gap({x, y}, 1.0, 1.2), expected, 1e-9);
        } else {
          EXPECT_LE(gap({x, y}, 1.0, 1.2), 1e-9) << "nobody stands inside";
        }
      }
    }
  }
}

}  // namespace
}  // namespace outrider
