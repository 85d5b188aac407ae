// A robot that follows pieces, and what holds it up on them.
#include "outrider/sim/bodies/piece_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

const PolygonGround& hall() {
  static const PolygonGround ground = *PolygonGround::of({{0, 0}, {10, 0}, {10, 4}, {0, 4}}, {}, 0.5);
  return ground;
}

PieceBody body_with(const TrackFaults& faults) {
  return {{{1, 2}, 0.0}, Pace{}, 0.0, hall(), Rng(1), faults};
}

const FollowPiece straight{{{1, 2}, {9, 2}, {}, 0.0}};

TEST(PieceBody, WheelsThatStickEndThePiece) {
  TrackFaults faults;
  faults.way.stuck_from_s = 10.0;
  PieceBody body = body_with(faults);
  const double end_s = body.begin(straight);
  EXPECT_DOUBLE_EQ(end_s, 11.0) << "it gives up after 1 s";
  const Vec2 there = body.pose().position;
  EXPECT_GT(there.x, 1.5);
  EXPECT_LT(there.x, 1.0 + 10.0 * Pace{}.speed_mps);
  EXPECT_EQ(body.touch_rad(), std::nullopt);
  body.begin(FollowPiece{{there, {9, 2}, {}, 0.0}});
  EXPECT_EQ(body.pose().position, there);
}

TEST(PieceBody, APostEndsThePieceWhereItIsTouched) {
  TrackFaults faults;
  faults.way.blocked_at_s = 5.0;
  PieceBody body = body_with(faults);
  body.begin(straight);
  EXPECT_EQ(body.hindrance().post_contacts(), 1U);
  ASSERT_TRUE(body.touch_rad());
  EXPECT_NEAR(*body.touch_rad(), 0.0, 1e-9) << "right ahead";
  const double before_m = 9.0 - body.pose().position.x;
  EXPECT_GT(before_m, 1.0);
  body.begin(FollowPiece{{body.pose().position, {1, 2}, {}, 0.0}});
  EXPECT_NEAR(body.pose().position.x, 1.0, 1e-9) << "it may drive away";
  EXPECT_EQ(body.touch_rad(), std::nullopt);
}

TEST(PieceBody, ItStopsOnTheTrueArc) {
  TrackFaults faults;
  faults.way.stuck_from_s = 4.321;
  PieceBody body({{5, 1}, 0.0}, Pace{}, 0.0, hall(), Rng(1), faults);
  body.begin(FollowPiece{{{5, 1}, {5, 3}, {5, 2}, pi}});
  EXPECT_GT(distance(body.pose().position, Vec2{5, 1}), 0.1);
  EXPECT_NEAR(distance(body.pose().position, Vec2{5, 2}), 1.0, 1e-12);
  const Vec2 arm = body.pose().position - Vec2{5, 2};
  EXPECT_NEAR(wrap_angle(body.pose().heading_rad - heading_of(perpendicular(arm))), 0.0, radians(1.0));
}

TEST(PieceBody, ItIsCarriedWithinTheHall) {
  TrackFaults faults;
  faults.way.kidnapping = {10.0, 100.0, 0.5};
  PieceBody body = body_with(faults);
  body.begin(straight);
  const auto from = body.take_carried_from();
  ASSERT_TRUE(from);
  EXPECT_FALSE(body.take_carried_from()) << "it is told once";
  EXPECT_EQ(from->position.y, 2.0);
  EXPECT_TRUE(hall().point_free(body.pose().position));
  EXPECT_GT(body.pose().position.y, 2.0);
  const PieceDrive& drive = body.drive();
  ASSERT_EQ(drive.carried.size(), 1U);
  EXPECT_DOUBLE_EQ(drive.carried[0].from_s, 10.0);
  EXPECT_DOUBLE_EQ(drive.carried[0].until_s, 11.0);
  EXPECT_NEAR(drive.length_m, from->position.x - 1.0, 1e-9) << "nobody drives while being carried";
}

TEST(PieceBody, SlipEndsAPieceShortInTheSameTime) {
  TrackFaults faults;
  faults.slip = 0.25;
  PieceBody sure = body_with({}), slips = body_with(faults);
  EXPECT_NEAR(slips.begin(straight), sure.begin(straight), 1e-9);
  EXPECT_NEAR(slips.pose().position.x, 1.0 + 0.75 * 8.0, 1e-9);
}

TEST(PieceBody, AWaitIsStanding) {
  PieceBody body = body_with({});
  EXPECT_DOUBLE_EQ(body.begin(Wait{7.0}), 7.0);
  EXPECT_EQ(body.pose().position, (Vec2{1, 2}));
  EXPECT_GT(body.begin(straight), 7.0);
}

}  // namespace
}  // namespace outrider
