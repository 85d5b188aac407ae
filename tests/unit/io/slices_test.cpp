#include "outrider/io/slices.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/data.hpp"

namespace outrider {
namespace {

std::string slices_fault(const std::string& text) {
  const auto slices = slices_from_text(text, "s.csv");
  return slices ? "none" : to_string(slices.error());
}

TEST(Slices, BothFormsAreRead) {
  const auto slices =
      slices_from_text("# walls\n0,1,2,3\n\n house , wall ,0,0,1,0\r\nhouse,box,0,0,0,1,1,1,1,0\n", "s.csv");
  ASSERT_TRUE(slices) << to_string(slices.error());
  ASSERT_EQ(slices->size(), 3U);
  EXPECT_EQ((*slices)[0].name, "");
  EXPECT_EQ((*slices)[0].corners, (std::vector<Vec2>{{0, 1}, {2, 3}}));
  EXPECT_EQ((*slices)[1].name, "house/wall");
  EXPECT_EQ((*slices)[2].corners, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})) << "counter-clockwise";
}

TEST(Slices, BrokenLinesAreNamed) {
  EXPECT_EQ(slices_fault("# a\n0,0,1\n"),
            "s.csv:2: the line has 3 numbers; expected x0,y0,x1,y1 or model,link,x0,y0,x1,y1,... in m");
  EXPECT_EQ(slices_fault("a,b,0,0,1,0,1\n").substr(0, 8), "s.csv:1:");
  EXPECT_EQ(
      slices_fault("a,b,0,0,1,x\n"),
      "s.csv:1: '1,x' is no place within 1e6 m; expected x0,y0,x1,y1 or model,link,x0,y0,x1,y1,... in m");
  EXPECT_EQ(slices_fault("0,0,1,nan\n").substr(0, 16), "s.csv:1: '1,nan'");
  EXPECT_EQ(slices_fault("0,0,1,2e6\n").substr(0, 16), "s.csv:1: '1,2e6'");
  EXPECT_EQ(slices_fault("0,0,1,0\n1,1,1,1\n"),
            "s.csv:2: a wall whose two ends are one has no length; take the line away");
  EXPECT_EQ(slices_fault("a,b,0,0,1,0,2,0\n"),
            "s.csv:1: its corners lie on one line; give a wall by its two ends");
  EXPECT_EQ(slices_fault("a,b,0,0,4,0,1,1,0,4\n"),
            "s.csv:1: the polygon is not convex: its corner 1,1 lies 1 m inside; cut it in convex parts");
  EXPECT_EQ(slices_fault("x\n").substr(0, 8), "s.csv:1:");
  EXPECT_EQ(slices_fault(",,,\n").substr(0, 8), "s.csv:1:");
}

/// What a plane cuts of the solid is the slice again.
TEST(Slices, StandUprightAsTheyWereCut) {
  const auto slices = slices_from_text(
      "0,1,2,3\na,wall,1,1,1,4\na,turned,0,0,2,1,1.5,2,-0.5,1\na,five,0,0,2,0,3,1,1,3,0,2\n", "s.csv");
  ASSERT_TRUE(slices) << to_string(slices.error());
  for (const WorldSlice& slice : *slices) {
    const Solid solid = upright(slice, "it", 1.0, 1.5);
    EXPECT_TRUE(footprint(solid, 0.0, 0.99).empty());
    EXPECT_TRUE(footprint(solid, 1.51, 3.0).empty());
    const auto gap = [&](Vec2 p, double low_m, double high_m) {
      double nearest = 1e9;
      for (const auto& piece : footprint(solid, low_m, high_m)) {
        nearest = std::min(nearest, signed_distance(p, piece));
      }
      return nearest;
    };
    const RoundedPolygon whole{slice.corners, 0.0};
    for (double x = -1.0; x < 4.0; x += 0.13) {
      for (double y = -1.0; y < 4.0; y += 0.17) {
        const double expected = signed_distance(Vec2{x, y}, whole);
        if (expected > 0.0) {
          EXPECT_NEAR(gap({x, y}, 1.18, 1.18), expected, 1e-9);
          EXPECT_NEAR(gap({x, y}, 1.0, 1.2), expected, 1e-9);
        } else {
          EXPECT_LE(gap({x, y}, 1.0, 1.2), 1e-9) << "nobody stands inside";
        }
      }
    }
  }
}

TEST(Slices, DamagedTextIsReadOrRefused) {
  Rng rng(3);
  const std::string text = "0,1,2,3\na,wall,1,1,1,4\na,box,0,0,2,0,2,1,0,1\n";
  for (int i = 0; i < 500; ++i) {
    const auto slices = slices_from_text(test::damaged(text, rng), "s.csv");
    for (std::size_t k = 0; slices && k < slices->size(); ++k) EXPECT_GE((*slices)[k].corners.size(), 2U);
  }
}

}  // namespace
}  // namespace outrider
