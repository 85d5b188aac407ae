#include "outrider/io/map/area_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Distance of two points of the ellipsoid of WGS 84 as a chord through the earth, which is shorter than the
/// arc by less than 2e-7 of it up to 10 km.
double chord_m(Vec2 a, Vec2 b) {
  const auto place = [](Vec2 p) {
    constexpr double equator_m = 6378137.0, e2 = 6.69437999014e-3;
    const double lon = radians(p.x), lat = radians(p.y);
    const double n = equator_m / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
    return std::array{n * std::cos(lat) * std::cos(lon), n * std::cos(lat) * std::sin(lon),
                      n * (1.0 - e2) * std::sin(lat)};
  };
  const auto p = place(a), q = place(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Any two points of any area 0.2 degrees across are as far apart as on the ellipsoid, and come back.
TEST(AreaFrame, DegreesKeepDistancesAndComeBack) {
  Rng rng(11);
  double farthest = 0.0;
  for (int k = 0; k < testing::cases(300); ++k) {
    const Vec2 low{rng.uniform(-179.0, 178.0), rng.uniform(-84.0, 84.0)};
    const auto point = [&] { return low + Vec2{rng.uniform(0.0, 0.2), rng.uniform(0.0, 0.2)}; };
    const AreaFrame frame = AreaFrame::of_degrees({low, low + Vec2{0.2, 0.2}});
    const Vec2 a = point(), b = a + 0.4 * (point() - a);
    const Vec2 p = frame.to_local(a), q = frame.to_local(b);
    const double chord = chord_m(a, b);
    EXPECT_NEAR(distance(p, q), chord, 2e-6 * chord + 1e-6) << low.x << ", " << low.y;
    farthest = std::max(farthest, chord_m(frame.to_file(p), a));
  }
  EXPECT_LT(farthest, 1e-4);
}

TEST(AreaFrame, EastIsRightAndNorthIsUp) {
  const AreaFrame frame = AreaFrame::of_degrees({{8.4, 49.0}, {8.5, 49.1}});
  EXPECT_EQ(frame.to_local({8.4, 49.0}), (Vec2{0.0, 0.0}));
  const Vec2 far = frame.to_local({8.5, 49.1});
  EXPECT_NEAR(far.x, 7307.0, 20.0);  // 0.1 degrees at 49.05 degrees north
  EXPECT_NEAR(far.y, 11122.0, 10.0);
}

TEST(AreaFrame, MetresFarFromTheOriginAreMovedByWholeMetres) {
  const AreaFrame near = AreaFrame::of_metres({{-20.0, 3.0}, {500.0, 900.0}}, 1e4);
  EXPECT_FALSE(near.moved());
  const Vec2 corner{456789.125, 5428123.75};
  const AreaFrame utm = AreaFrame::of_metres({corner, corner + Vec2{300.0, 200.0}}, 1e4);
  EXPECT_TRUE(utm.moved());
  EXPECT_EQ(utm.to_local(corner), (Vec2{0.125, 0.75}));
  EXPECT_EQ(utm.to_file({0.125, 0.75}), corner);
  EXPECT_EQ(sentence_of(utm), "metres east and north of (456789, 5428123)");
  EXPECT_EQ(place_text(utm, {0.125, 0.75}), "(456789.125, 5428123.75)");
}

}  // namespace
}  // namespace outrider
