// A robot that follows pieces.
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

TEST(PieceBody, ItDrivesAnArcOnTheArc) {
  PieceBody body({{5, 1}, 0.0}, Pace{}, 0.0, hall(), Rng(1));
  body.begin(FollowPiece{{{5, 1}, {5, 3}, {5, 2}, pi}});
  for (const Vec2 place : body.drive().way) EXPECT_NEAR(distance(place, Vec2{5, 2}), 1.0, 1e-12);
  EXPECT_NEAR(distance(body.pose().position, Vec2{5, 3}), 0.0, 1e-12);
  EXPECT_NEAR(body.pose().heading_rad, pi, 1e-9);
}

TEST(PieceBody, AWaitIsStanding) {
  PieceBody body({{1, 2}, 0.0}, Pace{}, 0.0, hall(), Rng(1));
  EXPECT_DOUBLE_EQ(body.begin(Wait{7.0}), 7.0);
  EXPECT_EQ(body.pose().position, (Vec2{1, 2}));
  EXPECT_GT(body.begin(FollowPiece{{{1, 2}, {9, 2}, {}, 0.0}}), 7.0);
}

}  // namespace
}  // namespace outrider
