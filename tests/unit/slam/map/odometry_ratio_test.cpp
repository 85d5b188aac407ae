#include "outrider/slam/map/odometry_ratio.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// The scales that the map and the wheels give to the true motion.
struct Scales {
  double map = 1.0, ways = 1.0, turns = 1.0;
};

/// A drive of 120 m in curves, by a map with steps off by 1 cm and by wheels with 5 % of noise a metre.
std::vector<CountedStep> drive(Rng rng, const Scales& scales) {
  std::vector<CountedStep> steps;
  for (int i = 0; i < 480; ++i) {
    const double way_m = 0.25, turn_rad = rng.uniform(-0.3, 0.6);
    const double root_m = std::sqrt(way_m);
    steps.push_back(
        {{{scales.ways * way_m + 0.05 * root_m * rng.normal(), 0.0},
          scales.turns * turn_rad + 0.02 * rng.normal()},
         {{scales.map * way_m + 0.01 * rng.normal(), 0.01 * rng.normal()}, turn_rad + 0.003 * rng.normal()}});
  }
  return steps;
}

std::string doubt(const Rng& rng, const Scales& scales) {
  return why_not_believed(compare_with_odometry(drive(rng, scales)));
}

TEST(OdometryRatio, IsThatOfTheTrueScales) {
  const Rng rng(1);
  for (int i = 0; i < testing::cases(20); ++i) {
    const OdometryRatio ratio = compare_with_odometry(drive(rng.child(std::to_string(i)), {1.05, 0.98, 1.1}));
    EXPECT_NEAR(ratio.ways.value, 1.05 / 0.98, 4.0 * ratio.ways.sd + 0.005) << i;
    EXPECT_NEAR(ratio.turns.value, 1.0 / 1.1, 4.0 * ratio.turns.sd + 0.005) << i;
    EXPECT_LT(ratio.ways.sd, 0.02);
    EXPECT_LT(ratio.turns.sd, 0.02);
  }
}

TEST(OdometryRatio, RangesOfAWrongScaleAreDoubtedAndWheelsOfAWrongSizeAreNot) {
  const Rng rng(2);
  for (int i = 0; i < testing::cases(20); ++i) {
    const Rng one = rng.child(std::to_string(i));
    EXPECT_EQ(doubt(one, {}), "") << i;
    EXPECT_EQ(doubt(one, {1.0, 1.1, 1.1}), "") << "wheels";
    EXPECT_NE(doubt(one, {1.12, 1.0, 1.0}), "") << "ranges";
    EXPECT_NE(doubt(one, {0.88, 1.0, 1.0}), "") << "ranges";
    EXPECT_NE(doubt(one, {1.1, 1.1, 1.1}), "") << "both, and the way is as long as the wheels say";
    EXPECT_NE(doubt(one, {0.88, 0.95, 0.95}), "") << "both, and ways are off by little";
  }
}

TEST(OdometryRatio, AShortDriveTellsNothing) {
  std::vector<CountedStep> few = drive(Rng(3), {1.1, 1.0, 1.0});
  few.resize(12);
  EXPECT_EQ(why_not_believed(compare_with_odometry(few)), "");
  EXPECT_EQ(why_not_believed(compare_with_odometry({})), "");
}

}  // namespace
}  // namespace outrider
