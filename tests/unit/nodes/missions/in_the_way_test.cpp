#include "outrider/nodes/missions/in_the_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

TEST(InTheWay, IsWhatTheDiskWouldReachBeforeItComesToRest) {
  StopRule rule;
  rule.radius_m = 0.2;
  rule.gap_m = 0.0;
  rule.reaction_s = 0.5;
  rule.braking_mps2 = 1.0;
  const Pose2 robot{{1.0, 2.0}, 0.0};
  const Twist2 twist{1.0, 0.0, 0.0};  // 1.5 m until it stands
  EXPECT_TRUE(in_the_way({{2.69, 2.0}}, robot, twist, rule));
  EXPECT_FALSE(in_the_way({{2.71, 2.0}}, robot, twist, rule));
  EXPECT_FALSE(in_the_way({{2.0, 2.21}, {0.9, 2.0}}, robot, twist, rule));  // beside it, and behind
  EXPECT_EQ(in_the_way({{2.4, 2.1}, {2.0, 2.1}}, robot, twist, rule), (Vec2{2.0, 2.1}));
  EXPECT_FALSE(in_the_way({{1.1, 2.0}}, robot, {0.0, 0.0, 3.0}, rule));   // a disk turns
  EXPECT_TRUE(in_the_way({{1.0, 1.0}}, robot, {0.0, -1.0, 0.0}, rule));   // sideways
  EXPECT_FALSE(in_the_way({{1.1, 2.0}}, robot, {-1.0, 0.0, 0.0}, rule));  // it leaves what it touches
}

/// The same question asked of every point along the way, a thousandth of it apart.
TEST(InTheWay, MissesNothingByMoreThanItsSteps) {
  Rng rng(5);
  StopRule rule;
  int blocked = 0;
  for (int round = 0; round < 1000; ++round) {
    const Twist2 twist{rng.uniform(-1.0, 1.0), rng.uniform(-0.5, 0.5), rng.uniform(-2.0, 2.0)};
    const Vec2 point{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)};
    const double speed = speed_of(twist);
    const double way_m = std::max(rule.least_m, speed * (rule.reaction_s + speed / rule.braking_mps2));
    double least_m = norm(point);
    const double first_m = least_m;
    for (int i = 1; i <= 1000; ++i)
      least_m = std::min(least_m, distance(point, moved({}, twist, way_m / speed * i / 1000.0).position));
    const double reach_m = rule.radius_m + rule.gap_m;
    const bool found = in_the_way({point}, {}, twist, rule).has_value();
    blocked += found;
    if (least_m < reach_m - 0.005 && least_m < first_m - 0.02) {
      EXPECT_TRUE(found) << round;
    }
    if (least_m > reach_m) {
      EXPECT_FALSE(found) << round;
    }
  }
  EXPECT_GT(blocked, 20);
}

}  // namespace
}  // namespace outrider
