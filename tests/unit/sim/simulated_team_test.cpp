#include "outrider/sim/simulated_team.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

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

/// A corridor of 9 cells, along which the target goes.
SimulatedTeam corridor_team(const TeamFaults& faults, int known_s = 0) {
  std::vector<Cell> target;
  for (int s = 0; s < 9; ++s) target.push_back({s, 0});
  const auto free = [](Cell cell) { return cell.y == 0 && cell.x >= 0 && cell.x < 9; };
  return {{{0, 0}}, target, known_s, faults, free, Rng(1)};
}

/// Lets the robot stand for a second.
GridObservation after_a_second(SimulatedTeam& team) {
  const Cell here = team.sense().grid->robots.front();
  team.act(StepToCell{0, here});
  return *team.sense().grid;
}

TEST(SimulatedTeamFaults, MissingSightingsLeaveGaps) {
  TeamFaults faults;
  faults.missing_from_s = 2.0;
  faults.missing_for_s = 2.0;
  SimulatedTeam team = corridor_team(faults);
  std::vector<int> seconds;
  for (int s = 1; s <= 5; ++s) {
    const GridObservation seen = after_a_second(team);
    if (seen.target.empty()) continue;
    seconds.push_back(*seen.target_from_s);
    EXPECT_EQ(seen.target, (std::vector<Cell>{{seconds.back(), 0}}));
  }
  EXPECT_EQ(seconds, (std::vector<int>{1, 4, 5}));
  EXPECT_EQ(team.counts().missing, 2);
}

TEST(SimulatedTeamFaults, LateSightingsTellTheirSecond) {
  TeamFaults faults;
  faults.late_s = 3;
  SimulatedTeam team = corridor_team(faults);
  for (int s = 1; s <= 6; ++s) {
    const GridObservation seen = after_a_second(team);
    EXPECT_EQ(seen.target.empty(), s < 4);
    EXPECT_EQ(seen.target_from_s, s < 4 ? std::nullopt : std::optional(s - 3));
  }
}

TEST(SimulatedTeamFaults, WrongSightingsAreOnTheMap) {
  TeamFaults faults;
  faults.wrong = 1.0;
  SimulatedTeam team = corridor_team(faults);
  for (int s = 1; s <= 8; ++s) {
    const GridObservation seen = after_a_second(team);
    ASSERT_EQ(seen.target.size(), 1U);
    EXPECT_NE(seen.target[0], (Cell{s, 0}));
    EXPECT_EQ(seen.target[0].y, 0);
    EXPECT_LE(std::abs(seen.target[0].x - s), 3);
  }
  EXPECT_EQ(team.counts().wrong, 8);
}

TEST(SimulatedTeamFaults, AStuckRobotStaysAndAClosedCellIsFelt) {
  TeamFaults stuck;
  stuck.stuck_from_s = 0.0;
  stuck.stuck_for_s = 1.0;
  SimulatedTeam team = corridor_team(stuck);
  team.act(StepToCell{0, {1, 0}});
  EXPECT_EQ(team.sense().grid->robots.front(), (Cell{0, 0}));
  EXPECT_TRUE(team.sense().grid->closed.empty());
  team.act(StepToCell{0, {1, 0}});
  EXPECT_EQ(team.sense().grid->robots.front(), (Cell{1, 0}));
  EXPECT_EQ(team.counts().stuck_s, 1);

  TeamFaults closes;
  closes.closed_at_s = 2.0;
  closes.closed_radius = 0;
  closes.closed_ahead = 1;
  SimulatedTeam other = corridor_team(closes);
  (void)after_a_second(other);
  (void)after_a_second(other);
  other.act(StepToCell{0, {1, 0}});
  EXPECT_EQ(other.sense().grid->closed.size(), 1U);
  EXPECT_EQ(other.sense().grid->robots.front(), (Cell{0, 0}));
  EXPECT_EQ(other.counts().blocked, 1);
}

TEST(SimulatedTeamFaults, ARobotIsPutOnAFreeCellAndFeelsTheTarget) {
  TeamFaults faults;
  faults.kidnapped_at_s = 3.0;
  SimulatedTeam team = corridor_team(faults);
  (void)after_a_second(team);
  (void)after_a_second(team);
  EXPECT_FALSE(team.counts().kidnapped);
  const GridObservation seen = after_a_second(team);
  EXPECT_TRUE(team.counts().kidnapped);
  EXPECT_NE(seen.robots.front(), (Cell{0, 0}));
  EXPECT_EQ(seen.robots.front().y, 0);
  EXPECT_EQ(seen.caught, seen.robots.front() == (Cell{3, 0}));
}

}  // namespace
}  // namespace outrider
