// The job plan on ground that costs more in some places.
#include <cmath>

#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "plan_case.hpp"

namespace outrider {
namespace {

// 9 x 9 free cells; the middle column is black but in the lowest row.
const std::string field =
    "type octile\nheight 9\nwidth 9\nmap\n.........\n.........\n.........\n.........\n.........\n"
    ".........\n.........\n.........\n.........\n";

std::string swamp() {
  std::string text = "P2 9 9 255\n";
  for (int y = 8; y >= 0; --y) {
    for (int x = 0; x < 9; ++x) text += x == 4 && y > 0 ? "0 " : "255 ";
    text += "\n";
  }
  return text;
}

class GroundCosts : public PlanCase {
 protected:
  Changes with(Changes more) {
    Changes all{{"map", write("field.map", field)}, {"from", "0.5,2.5"}, {"to", "8.5,2.5"}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_F(GroundCosts, AnIndexThatDoesNotFitIsAWarning) {
  std::string open = "type octile\nheight 200\nwidth 200\nmap\n";
  for (int y = 0; y < 200; ++y) open += std::string(200, '.') + "\n";
  Changes ask{{"map", write("open.map", open)},
              {"planner", "terrain_labels"},
              {"from", "0.5,0.5"},
              {"to", "199.5,150.5"},
              {"terrain_labels.hub_memory", "1"}};
  const auto small = plan(ask);
  ASSERT_TRUE(small.has_value()) << to_string(small.error());
  ASSERT_EQ(small->report.warnings.size(), 1U);
  EXPECT_EQ(small->report.warnings.front(),
            "terrain_a_star answers, since the labels of 200 x 200 cells do not fit into 1 MiB; give more "
            "hub_memory, or a coarser map");
  const auto fits = plan(with({{"costs", write("swamp.pgm", swamp())}, {"planner", "terrain_labels"}}));
  ASSERT_TRUE(fits.has_value()) << to_string(fits.error());
  EXPECT_TRUE(fits->report.warnings.empty());
}

TEST_F(GroundCosts, TheDefaultPlannerWeighsThem) {
  const auto run = plan(with({{"costs", write("swamp.pgm", swamp())}}));
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_EQ(text_of(*run, 0, "planner"), "terrain_theta_star");
  EXPECT_EQ(text_of(*run, 0, "cost_unit"), "m eq");
  EXPECT_NEAR(number_of(*run, 0, "cost"), 2.0 * std::hypot(4.0, 2.0), 1e-9);
  const auto* drawn = run->log.latest<outrider_msgs::CostGrid>(topic::cost_grid);
  ASSERT_NE(drawn, nullptr);
  EXPECT_EQ(std::count(drawn->costs.begin(), drawn->costs.end(), 10.0), 8);
  const auto cheap = plan(with({{"costs", write("swamp.pgm", swamp())}, {"cost_of_black", "1.01"}}));
  ASSERT_TRUE(cheap.has_value());
  EXPECT_NEAR(number_of(*cheap, 0, "cost"), 8.01, 1e-6) << "straight through";
  const auto without = plan(with({}));
  EXPECT_EQ(without->log.latest<outrider_msgs::CostGrid>(topic::cost_grid), nullptr);
  EXPECT_EQ(text_of(*without, 0, "planner"), "theta_star");
}

TEST_F(GroundCosts, CompareAsksThoseThatWeigh) {
  const auto run = plan(with({{"costs", write("swamp.pgm", swamp())}, {"compare", "true"}}));
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  ASSERT_EQ(rows_of(*run), 3U);
  EXPECT_EQ(text_of(*run, 0, "planner"), "terrain_a_star");
  EXPECT_EQ(text_of(*run, 0, "guarantee"), "grid_optimal");
  EXPECT_EQ(text_of(*run, 1, "planner"), "terrain_labels");
  EXPECT_NEAR(number_of(*run, 1, "cost"), number_of(*run, 0, "cost"), 1e-9);
  EXPECT_EQ(text_of(*run, 2, "guarantee"), "none");
}

/// A ramp of 45 degrees in the upper half: a metre on it costs 1 + slope_cost.
TEST_F(GroundCosts, SlopesCost) {
  const std::string ramp = "ncols 3\nnrows 3\nxllcenter -1\nyllcenter -1\ncellsize 5\n5 5 5\n0 0 0\n0 0 0\n";
  const auto run =
      plan(with({{"terrain", write("ramp.asc", ramp)}, {"slope_cost", "4"}, {"from", "0.5,8.5"}}));
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  const auto* drawn = run->log.latest<outrider_msgs::CostGrid>(topic::cost_grid);
  ASSERT_NE(drawn, nullptr);
  EXPECT_NEAR(drawn->costs.front(), 1.0, 1e-6);
  EXPECT_NEAR(drawn->costs.back(), 5.0, 1e-6);
  EXPECT_GT(number_of(*run, 0, "cost"), number_of(*run, 0, "length_m") + 10.0);
}

TEST_F(GroundCosts, PolygonsHaveCostsOnTheirGrid) {
  const std::string posts = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 8\n2 2\n2 2\n";
  const auto run =
      plan({{"map", write("room.txt", room)}, {"query", "1"}, {"costs", write("two.asc", posts)}});
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_NEAR(number_of(*run, 0, "cost"), 2.0 * number_of(*run, 0, "length_m"), 1e-9);
}

TEST_F(GroundCosts, WhatDoesNotFitIsRefusedWithItsKey) {
  const std::string costs = write("swamp.pgm", swamp()), hill = write("hill.asc", "ncols 2\n");
  const auto says = [&](const Changes& more, const std::string& words) {
    const std::string sentence = refusal(with(more));
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  says({{"costs", costs}, {"planner", "a_star"}},
       "planner: a_star does not weigh the costs of the ground; take");
  says({{"slope_cost", "2"}}, "slope_cost: it needs slopes, and the map has none");
  says({{"terrain", hill}}, "terrain: its slopes cost nothing; give slope_cost too");
  says({{"terrain", hill}, {"slope_cost", "1"}}, "hill.asc");
  says({{"costs", write("small.pgm", "P2 2 2 255\n0 0\n0 0\n")}}, "small.pgm: the image has 2 x 2 pixels");
  says({{"costs", costs}, {"cost_of_black", "0.5"}}, "cost_of_black: '0.5' ");
  says({{"costs", write("zero.asc", "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 8\n0 0\n0 0\n")}},
       "zero.asc: the cost 0 of cell (0, 0) is not valid");
  says({{"costs", costs}, {"model", "corners"}}, "terrain_theta_star takes");
}

}  // namespace
}  // namespace outrider
