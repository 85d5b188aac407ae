#include "outrider/io/map/cost_map.hpp"

#include <gtest/gtest.h>

#include "support/data.hpp"

namespace outrider {
namespace {

class CostMapTest : public ::testing::Test {
 protected:
  std::string refusal(const std::string& content) {
    const auto map = load_cost_map(folder_.write("costs", content), 10.0);
    return map ? "taken" : to_string(map.error());
  }
  test::Folder folder_;
};

TEST_F(CostMapTest, APixelIsACellAndBlackIsDear) {
  const auto map = load_cost_map(folder_.write("costs.pgm", "P2 3 2 255\n255 0 255\n204 255 102\n"), 11.0);
  ASSERT_TRUE(map.has_value()) << to_string(map.error());
  const GridFrame frame{{5.0, -2.0}, 0.25, 3, 2};
  const auto costs = costs_of(*map, frame, 0.7);
  ASSERT_TRUE(costs.has_value());
  EXPECT_EQ(costs->frame, frame);
  EXPECT_EQ(costs->cells, (std::vector<float>{3.0F, 1.0F, 7.0F, 1.0F, 11.0F, 1.0F}))
      << "the last row is the lowest";
}

TEST_F(CostMapTest, AnImageOfAnotherSizeIsRefusedWithBothSizes) {
  const auto map = load_cost_map(folder_.write("costs.pgm", "P2 2 1 255\n0 0\n"), 5.0);
  ASSERT_TRUE(map.has_value());
  const auto costs = costs_of(*map, {{}, 1.0, 4, 3}, 0.0);
  ASSERT_FALSE(costs.has_value());
  EXPECT_NE(to_string(costs.error()).find("costs.pgm: the image has 2 x 1 pixels and the map 4 x 3 cells"),
            std::string::npos)
      << to_string(costs.error());
}

/// Posts are where the file says, whatever the grid is; between them the cost is interpolated.
TEST_F(CostMapTest, PostsStandInTheWorld) {
  const std::string text =
      "ncols 3\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 10\n5 5 5\n1 2 3\n";  // + 0.1 a metre along x
  const auto map = load_cost_map(folder_.write("costs.asc", text), 1.0);
  ASSERT_TRUE(map.has_value()) << to_string(map.error());
  const auto costs = costs_of(*map, {{-20.0, -0.5}, 1.0, 60, 1}, 0.0);
  ASSERT_TRUE(costs.has_value());
  EXPECT_FLOAT_EQ(costs->cells[0], 1.0F) << "beyond the posts";
  EXPECT_FLOAT_EQ(costs->cells[24], 1.45F);
  EXPECT_FLOAT_EQ(costs->cells[59], 3.0F);
  const auto turned = costs_of(*map, {{0.5, 0.0}, 1.0, 10, 1}, 1.5707963267948966);
  ASSERT_TRUE(turned.has_value());
  EXPECT_GT(turned->cells[9], 4.5F) << "the row of cells leads to the upper posts";
}

TEST_F(CostMapTest, WhatIsNoCostMapIsRefused) {
  EXPECT_NE(refusal("P5 2 2 255\n\1").find("costs"), std::string::npos);
  EXPECT_NE(refusal("nothing").find("costs"), std::string::npos);
  EXPECT_NE(refusal("ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n1 2\n3 x\n").find("'x'"),
            std::string::npos);
  EXPECT_NE(to_string(load_cost_map((folder_.path / "none.png").string(), 2.0).error()).find("none.png"),
            std::string::npos);
}

}  // namespace
}  // namespace outrider
