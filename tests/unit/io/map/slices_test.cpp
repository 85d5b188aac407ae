#include "outrider/io/map/slices.hpp"

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
