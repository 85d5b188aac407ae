#include "steering/motions/lattice_motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "outline_way.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

class LatticeMotionsOf : public ::testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Headings, LatticeMotionsOf, ::testing::Values(8U, 16U, 32U));

TEST_P(LatticeMotionsOf, BeginAndEndOnTheLatticeAndAreNotTooTight) {
  for (const double radius : {0.3, 1.0, 2.5, 8.0}) {
    LatticeMotions motions;
    motions.make({GetParam(), 2, radius, true, 2.0, {{}}, 100});
    ASSERT_EQ(motions.headings(), GetParam());
    for (std::uint32_t heading = 0; heading < GetParam(); ++heading) {
      std::set<std::uint32_t> reached;
      for (const LatticeMotion& motion : motions.from(heading)) {
        const auto& pieces = motion.pieces;
        ASSERT_FALSE(pieces.empty());
        const Vec2 end{motion.shift.x + 0.5, motion.shift.y + 0.5};
        EXPECT_LT(distance(pieces.front().from, Vec2{0.5, 0.5}), 1e-9);
        EXPECT_LT(distance(pieces.back().to, end), 1e-9);
        const auto agree = [](double a, double b) { return std::abs(wrap_angle(a - b)) < 1e-6; };
        EXPECT_TRUE(agree(heading_in(pieces.front()), motions.heading_rad(heading)));
        EXPECT_TRUE(agree(heading_out(pieces.back()), motions.heading_rad(motion.heading)));
        double length = 0.0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
          length += length_of(pieces[i]);
          EXPECT_EQ(pieces[i].backward, motion.backward);
          if (pieces[i].turn_rad != 0.0) {
            EXPECT_GE(distance(pieces[i].centre, pieces[i].from), radius - 1e-6);
          }
          if (i == 0) continue;
          EXPECT_LT(distance(pieces[i - 1].to, pieces[i].from), 1e-9);
          EXPECT_TRUE(agree(heading_out(pieces[i - 1]), heading_in(pieces[i])));
        }
        EXPECT_NEAR(motion.cost, (motion.backward ? 2.0 : 1.0) * length, 1e-9);
        if (!motion.backward) reached.insert(motion.heading);
      }
      EXPECT_EQ(reached.size(), 1 + GetParam() / 2) << "a quarter to each side, and ahead";
    }
  }
}

TEST_P(LatticeMotionsOf, TouchTheCellsThatTheRobotDrivesOver) {
  constexpr std::int32_t stride = 1000;
  const std::vector<Vec2> outline = {{-0.6, -0.8}, {1.9, -0.5}, {1.9, 0.7}, {-0.6, 0.8}};
  LatticeMotions motions;
  motions.make({GetParam(), 2, 2.0, true, 1.0, outline, stride});
  for (std::uint32_t heading = 0; heading < GetParam(); ++heading) {
    for (const LatticeMotion& motion : motions.from(heading)) {
      std::vector<OutlineWay> ways;
      for (const PathPiece& piece : motion.pieces)
        ways.emplace_back(piece, heading_in(piece), outline, GridFrame{{}, 1.0, 1, 1});
      for (int y = motion.low.y - 1; y <= motion.high.y + 1; ++y) {
        for (int x = motion.low.x - 1; x <= motion.high.x + 1; ++x) {
          double apart = 1e9;
          for (const OutlineWay& way : ways) apart = std::min(apart, way.gap({x, y}));
          if (apart > 0.0 && apart < 1e-6) continue;
          EXPECT_EQ(std::ranges::binary_search(motion.touched, y * stride + x), apart == 0.0)
              << x << " " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace outrider
