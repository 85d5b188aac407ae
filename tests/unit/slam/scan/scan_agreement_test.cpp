// The judgement of two scans about each other, in rooms whose walls are known.
#include "scan/scan_agreement.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

LaserScan room_scan(const std::vector<testing::Wall>& walls, const Pose2& pose, Rng& rng, int beams = 360) {
  testing::Finder finder;
  finder.beams = beams;
  finder.step_rad = 2.0 * pi / 360.0;
  finder.first_rad = -0.5 * beams * finder.step_rad;
  finder.most_m = 10.0;
  return testing::scan_from(walls, pose, finder, rng);
}

TEST(ScanAgreement, ScansOfOneRoomDoNotContradictEachOther) {
  Rng rng(1);
  const auto walls = testing::furnished_room();
  for (int trial = 0; trial < testing::cases(50); ++trial) {
    const Pose2 a{{rng.uniform(1.8, 2.8), rng.uniform(1.5, 3.5)}, rng.uniform(-pi, pi)};
    const Pose2 b{{rng.uniform(1.8, 2.8), rng.uniform(1.5, 3.5)}, rng.uniform(-pi, pi)};
    const Agreement pair = mutual_agreement(room_scan(walls, a, rng), a, room_scan(walls, b, rng), b);
    EXPECT_GT(pair.seen(), 200U);
    EXPECT_LT(pair.contradiction(), 0.01);
  }
}

/// Each point of the near wall lies where the other scan looked through, and no point of the far wall does.
TEST(ScanAgreement, CountsThePointsThatTheOtherLookedThrough) {
  Rng rng(2);
  const Pose2 centre{{3.0, 3.0}, 0.0};
  const LaserScan small = room_scan(testing::box_walls({2, 2}, {4, 4}), centre, rng);
  const LaserScan large = room_scan(testing::box_walls({0, 0}, {6, 6}), centre, rng);
  const Agreement of_small = agreement(small, centre, large, centre);
  EXPECT_EQ(of_small.seen_through, of_small.seen());
  EXPECT_GT(of_small.seen(), 170U);
  const Agreement of_large = agreement(large, centre, small, centre);
  EXPECT_EQ(of_large.seen(), 0U) << "the small room hides the walls of the large one";
  EXPECT_EQ(mutual_agreement(small, centre, large, centre).contradiction(), 1.0);
}

TEST(ScanAgreement, AWrongPoseIsContradicted) {
  Rng rng(3);
  const auto walls = testing::furnished_room();
  const Pose2 a{{2.2, 2.0}, 0.3}, b{{2.4, 2.2}, -0.2};
  const LaserScan of_a = room_scan(walls, a, rng), of_b = room_scan(walls, b, rng);
  ASSERT_LT(mutual_agreement(of_a, a, of_b, b).contradiction(), 0.01);
  const Pose2 off{b.position + Vec2{1.5, 0.0}, b.heading_rad};
  EXPECT_GT(mutual_agreement(of_a, a, of_b, off).contradiction(), 0.1);
}

TEST(ScanAgreement, SaysNothingOfWhatItCannotSee) {
  Rng rng(4);
  const auto walls = testing::furnished_room();
  const Pose2 ahead{{2.2, 2.0}, 0.0}, back{{2.2, 2.0}, pi};
  const LaserScan one = room_scan(walls, ahead, rng, 120), other = room_scan(walls, back, rng, 120);
  EXPECT_EQ(mutual_agreement(one, ahead, other, back).seen(), 0U);
  LaserScan blind = one;
  blind.ranges_m.assign(blind.ranges_m.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(agreement(one, ahead, blind, ahead).seen(), 0U);
  EXPECT_EQ(agreement(blind, ahead, one, ahead).seen(), 0U);
}

/// A laser that is mounted upside down turns the other way, and sees the same.
TEST(ScanAgreement, TheDirectionOfTheSweepDoesNotMatter) {
  Rng rng(5);
  const Pose2 a{{2.2, 2.0}, 0.3}, b{{2.4, 2.2}, -0.2};
  const LaserScan of_a = room_scan(testing::furnished_room(), a, rng, 200);
  LaserScan of_b = room_scan(testing::furnished_room(), b, rng, 200);
  const Agreement before = mutual_agreement(of_a, a, of_b, b);
  ASSERT_GT(before.seen(), 100U);
  of_b.first_rad += 199 * of_b.step_rad;
  of_b.step_rad = -of_b.step_rad;
  std::ranges::reverse(of_b.ranges_m);
  const Agreement after = mutual_agreement(of_a, a, of_b, b);
  EXPECT_NEAR(static_cast<double>(after.agreeing), static_cast<double>(before.agreeing), 2.0);
  EXPECT_EQ(after.seen_through, before.seen_through);
}

}  // namespace
}  // namespace outrider
