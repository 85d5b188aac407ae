#include "outrider/jobs/guard/team/team_plan.hpp"

#include <gtest/gtest.h>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

TEST(StartsOfTeam, AreApartOnReachableGroundAndTheSameTwice) {
  Rng rng(57);
  int found = 0;
  for (int i = 0; i < cases(30); ++i) {
    const auto problem = testing::random_guard_problem(rng, 8, 2, 3.0);
    const auto firing_map = build_firing_map(problem, testing::quick());
    ASSERT_TRUE(firing_map.has_value());
    const std::size_t robots = 2 + static_cast<std::size_t>(i) % 4;
    const auto starts = starts_of_team(problem, *firing_map, robots, {});
    if (!starts) {
      EXPECT_EQ(starts.error().where, "robots");
      continue;
    }
    ++found;
    ASSERT_EQ(starts->size(), robots);
    EXPECT_EQ(starts->front().position, problem.start.position);
    EXPECT_TRUE(check_starts(problem, *firing_map, *starts));
    const auto again = starts_of_team(problem, *firing_map, robots, {}).value();
    for (std::size_t r = 0; r < robots; ++r) EXPECT_EQ(again[r].position, (*starts)[r].position);
  }
  EXPECT_GT(found, cases(30) / 2);
}

TEST(StartsOfTeam, AreSideBySideWhereThereIsRoom) {
  GuardProblem problem;
  problem.world.bounds = {{-5, -5}, {5, 5}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{0.0, 0.0}, pi / 2};
  const auto firing_map = build_firing_map(problem, testing::quick());
  ASSERT_TRUE(firing_map.has_value());
  const auto starts = starts_of_team(problem, *firing_map, 3, {}).value();
  const double cell_m = testing::quick().resolution_m;
  for (std::size_t r = 1; r < 3; ++r) {
    EXPECT_LE(std::abs(starts[r].position.y), cell_m);
    EXPECT_GE(std::abs(starts[r].position.x), 2.0 * simulated_gap_m(problem) - cell_m);
    EXPECT_LE(std::abs(starts[r].position.x), 2.0 * simulated_gap_m(problem) + 2.0 * cell_m);
    EXPECT_EQ(starts[r].heading_rad, problem.start.heading_rad);
  }
  EXPECT_LT(starts[1].position.x * starts[2].position.x, 0.0);  // one on either side
}

TEST(StartsOfTeam, RefusesStartsOfOthersAndYardsThatAreTooSmall) {
  GuardProblem problem;
  problem.world.bounds = {{-0.8, -0.4}, {0.8, 0.4}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{0.0, 0.0}, 0.0};
  const auto firing_map = build_firing_map(problem, testing::quick());
  ASSERT_TRUE(firing_map.has_value());
  const auto crowded = starts_of_team(problem, *firing_map, 5, {});
  ASSERT_FALSE(crowded);
  EXPECT_EQ(crowded.error().where, "robots");
  EXPECT_NE(crowded.error().sentence.find("set robots to"), std::string::npos);
  const auto near = starts_of_team(problem, *firing_map, 2, {{{0.1, 0.0}, 0.0}});
  ASSERT_FALSE(near);
  EXPECT_EQ(near.error().where, "robot_starts");
  EXPECT_NE(near.error().sentence.find("0.10 m apart"), std::string::npos);
}

}  // namespace
}  // namespace outrider
