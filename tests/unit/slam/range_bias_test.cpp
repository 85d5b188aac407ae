#include "range_bias.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/slam/range_residuals.hpp"
#include "outrider/slam/repeated_scans.hpp"

namespace outrider {
namespace {

/// Returns the bias that is found in scans of a furnished room from exact poses.
double found_bias_m(double bias_m) {
  Rng rng(1);
  const auto drive =
      testing::drive_along({{0.6, 2.0}, {2.4, 2.0}, {2.4, 3.4}, {5.2, 3.4}, {5.2, 0.8}}, 0.0, rng);
  KeyframeGraph graph;
  for (std::size_t i = 0; i < drive.poses.size(); i += 5) {
    LaserScan scan = testing::scan_from(testing::furnished_room(), drive.poses[i], {}, rng);
    for (float& range_m : scan.ranges_m) range_m += static_cast<float>(bias_m);
    graph.keyframes.push_back({drive.poses[i], 0.0, scan});
  }
  KeyframeSurfaces surfaces({}, 30.0);
  return range_bias_m(graph, surfaces);
}

TEST(RangeBias, IsThatOfTheRanges) {
  for (const double bias_m : {-0.15, 0.0, 0.1}) EXPECT_NEAR(found_bias_m(bias_m), bias_m, 0.03) << bias_m;
}

TEST(RangeBias, IsUnknownWithoutScans) {
  KeyframeSurfaces surfaces({}, 30.0);
  EXPECT_EQ(range_bias_m({}, surfaces), 0.0);
}

TEST(RangeResiduals, OnlyAMeanThatNoiseDoesNotExplainIsABias) {
  RangeResiduals honest, few, biased;
  Rng rng(1);
  for (int i = 0; i < 400; ++i) {
    honest.add(0.1 * rng.normal(), 0.1);
    biased.add(0.05 + 0.1 * rng.normal(), 0.1);
  }
  for (int i = 0; i < 20; ++i) few.add(0.05 + 0.1 * rng.normal(), 0.1);
  EXPECT_FALSE(honest.is_biased(1.0));
  EXPECT_FALSE(few.is_biased(1.0));
  EXPECT_TRUE(biased.is_biased(1.0));
  EXPECT_FALSE(biased.is_biased(9.0)) << "errors are three times as large as told";
  EXPECT_NEAR(biased.mean_m(), 0.05, 0.02);
}

TEST(RepeatedScans, AreThoseWithTheSameRangesAfterAMotion) {
  RepeatedScans repeated;
  LaserScan scan{0.0, 0.0, 0.1, 0.0, 10.0, {1.0F, 2.0F}};
  EXPECT_FALSE(repeated.repeats(scan, {}));
  EXPECT_FALSE(repeated.repeats(scan, {})) << "it stands";
  EXPECT_TRUE(repeated.repeats(scan, {{0.1, 0.0}, 0.0}));
  EXPECT_TRUE(repeated.repeats(scan, {{0.0, 0.0}, 0.1}));
  scan.ranges_m[0] = 1.1F;
  EXPECT_FALSE(repeated.repeats(scan, {{0.2, 0.0}, 0.0}));
}

}  // namespace
}  // namespace outrider
