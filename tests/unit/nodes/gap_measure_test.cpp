// GapMeasure against gaps whose width is known.
#include "outrider/nodes/gap_measure.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

/// A robot at the origin that looks along x, into a gap between the ends of two walls across its way.
class Before {
 public:
  explicit Before(double width_m) {
    tf2_msgs::TFMessage fixed, moving;
    fixed.transforms.push_back(transform_of(0.0, Pose2{}, "base_link", "laser"));
    moving.transforms.push_back(transform_of(0.0, Pose2{}, "odom", "base_link"));
    EXPECT_TRUE(frames.add(fixed, Transforms::fixed, 0.0));
    EXPECT_TRUE(frames.add(moving, Transforms::moving, 0.0));
    for (int i = 0; i <= 60; ++i) way.points.push_back({0.01 * i, 0.0});
    way.narrowest = {0.35, 0.0};
    half_m_ = 0.5 * width_m;
  }

  /// Takes a scan and looks.
  void look() {
    time_s_ += 0.2;
    sensor_msgs::LaserScan message;
    message.header = header_of(time_s_, "laser");
    message.angle_min = -1.5F;
    message.angle_max = 1.5F;
    message.angle_increment = 0.01F;
    message.range_min = 0.1F;
    message.range_max = 3.5F;
    for (int i = 0; i <= 300; ++i)
      message.ranges.push_back(static_cast<float>(range_m(-1.5 + 0.01 * i) + 0.005 * rng_.normal()));
    tf2_msgs::TFMessage moving;
    moving.transforms.push_back(transform_of(time_s_, Pose2{}, "odom", "base_link"));
    EXPECT_TRUE(frames.add(moving, Transforms::moving, time_s_));
    EXPECT_TRUE(scan.take(message, frames, time_s_));
    measure.add(scan, frames);
    measure.look(way, Pose2{}, 0.105);
  }

  NarrowWay way;
  RobotFrames frames{FrameNames{}};
  ScanPoints scan{2.4};
  GapMeasure measure;

 private:
  /// Two walls 0.3 m thick at x = 0.35; behind them nothing.
  [[nodiscard]] double range_m(double bearing_rad) const {
    constexpr double front_m = 0.35, back_m = 0.65;
    const double slope = std::abs(std::tan(bearing_rad));
    if (front_m * slope >= half_m_) return front_m / std::cos(bearing_rad);
    if (back_m * slope >= half_m_) return half_m_ / std::abs(std::sin(bearing_rad));
    return 10.0;
  }

  double half_m_ = 0.0, time_s_ = 1.0;
  Rng rng_{5};
};

class Gap : public ::testing::TestWithParam<double> {};

TEST_P(Gap, IsAsWideAsItIs) {
  Before before(GetParam());
  for (int i = 0; i < 12; ++i) before.look();
  ASSERT_TRUE(before.measure.gap());
  EXPECT_NEAR(before.measure.gap()->width_m, GetParam(), 0.012);
  EXPECT_TRUE(before.measure.gap()->measured);
}

INSTANTIATE_TEST_SUITE_P(OfWidth, Gap, ::testing::Values(0.16, 0.18, 0.2, 0.22, 0.24, 0.28));

TEST(GapMeasure, KnowsNothingBeforeItHasLookedForAWhile) {
  Before before(0.2);
  EXPECT_FALSE(before.measure.gap());
  before.measure.look(before.way, Pose2{}, 0.105);  // no scan has come
  for (int i = 0; i < 5; ++i) before.look();
  before.measure.look(before.way, Pose2{}, 0.105);  // the same scan once more
  EXPECT_FALSE(before.measure.gap());
  before.look();
  EXPECT_TRUE(before.measure.gap());
  before.measure.begin_anew();
  EXPECT_FALSE(before.measure.gap());
}

}  // namespace
}  // namespace outrider
