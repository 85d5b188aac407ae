#include "outrider/jobs/explore/map/close_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

constexpr Vec2 corner{0.4, 0.0};  // of a solid to its right and below

/// The ends of beams on both faces of the corner, 5 mm apart, with the noise of a range finder.
std::vector<Vec2> ends_on_corner(Rng& rng) {
  std::vector<Vec2> ends;
  const auto add = [&](Vec2 there) {
    const double range_m = norm(there);
    ends.push_back((1.0 + 0.01 * rng.normal() / range_m) * there);
  };
  for (double along_m = 0.0; along_m < 0.3; along_m += 0.005) {
    add(corner + Vec2{along_m, 0.0});
    add(corner + Vec2{0.0, -along_m});
  }
  return ends;
}

TEST(CloseRange, KnowsACornerToSevenMillimetres) {
  constexpr double away_m = 0.1;
  const Vec2 outwards{-std::sqrt(0.5), std::sqrt(0.5)};
  const Pose2 robot{{-0.2, 0.3}, 0.0};  // it sees both faces
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    CloseRange close;
    for (int scan = 0; scan < 12; ++scan) {
      std::vector<Vec2> ends = ends_on_corner(rng);
      for (Vec2& end : ends) end = end - robot.position;
      close.add(robot, std::move(ends));
    }
    const Nearby surfaces(close.surfaces(robot, robot), 0.0005);
    EXPECT_NEAR(surfaces.clearance(corner + away_m * outwards), away_m, 0.007) << seed;
    EXPECT_NEAR(surfaces.clearance(Vec2{0.6, away_m}), away_m, 0.003) << seed;
  }
}

TEST(GapLooks, AreAMeanOfTheLastOnesAtOnePlace) {
  GapLooks looks;
  for (int i = 0; i < 40; ++i) looks.add({i % 2 == 0 ? 0.10 : 0.12, {1.0 + 0.001 * i, 0.0}});
  EXPECT_EQ(looks.count, 40);
  EXPECT_NEAR(looks.room_m, 0.11, 0.002);
  looks.add({0.3, {2.0, 0.0}});
  EXPECT_EQ(looks.count, 1) << "another place";
  EXPECT_DOUBLE_EQ(looks.room_m, 0.3);
}

}  // namespace
}  // namespace outrider
