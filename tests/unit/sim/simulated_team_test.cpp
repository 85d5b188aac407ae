#include "outrider/sim/simulated_team.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(SimulatedTeam, EachStepIsASecondAndShowsMoreOfTheTarget) {
  SimulatedTeam team({{0, 0}, {5, 5}}, {{1, 0}, {2, 0}, {3, 0}, {4, 0}}, 1);
  Observation seen = team.sense();
  EXPECT_EQ(seen.time_s, 0.0);
  EXPECT_EQ(seen.grid->target, (std::vector<Cell>{{1, 0}, {2, 0}}));
  EXPECT_TRUE(team.sense().grid->target.empty()) << "what is known is told once";
  team.act(Wait{9.0});
  EXPECT_EQ(team.sense().time_s, 0.0);
  team.act(StepToCell{1, {5, 4}});
  seen = team.sense();
  EXPECT_EQ(seen.time_s, 1.0);
  EXPECT_EQ(seen.grid->robots, (std::vector<Cell>{{0, 0}, {5, 4}}));
  EXPECT_EQ(seen.grid->target, (std::vector<Cell>{{3, 0}}));
}

TEST(SimulatedTeam, KnowsTheWholePathUnlessTold) {
  EXPECT_EQ(SimulatedTeam({{0, 0}}, {{1, 0}, {2, 0}, {3, 0}}).sense().grid->target.size(), 3U);
}

}  // namespace
}  // namespace outrider
