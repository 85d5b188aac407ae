#include "team/team_schedule.hpp"

#include <gtest/gtest.h>

#include "support/guard_yard.hpp"

namespace outrider {
namespace {

/// Two robots whose only ways cross in the middle; the second one was admitted first.
TeamPlan crossing() {
  TeamPlan plan;
  plan.parts.resize(2);
  plan.parts[0].start = {{-2, 0}, 0.0};
  plan.parts[0].plan.stops.push_back({{2, 0}, {{-2, 0}, {2, 0}}, {}});
  plan.parts[0].times.turns = {1};
  plan.parts[1].start = {{0, -2}, 0.0};
  plan.parts[1].plan.stops.push_back({{0, 2}, {{0, -2}, {0, 2}}, {}});
  plan.parts[1].times.turns = {0};
  return plan;
}

GuardProblem open_ground() {
  GuardProblem problem;
  problem.world.bounds = {{-3, -3}, {3, 3}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{-2, 0}, 0.0};
  problem.targets = {{"cat", {2, 2, 0}, {0.3, 0.3, 0.3}}};
  return problem;
}

struct Asked {
  TeamPlan plan = crossing();
  GuardProblem problem = open_ground();
  FiringMap firing_map = build_firing_map(problem, testing::quick()).value();
  TaskBoard one{problem, firing_map, 0}, other{problem, firing_map, 0};

  Asked() {
    one.set_tasks({{plan.parts[0].plan.stops[0].position}});
    other.set_tasks({{plan.parts[1].plan.stops[0].position}});
  }
  [[nodiscard]] std::optional<std::size_t> waits_for(std::size_t robot) const {
    const PlannedStop& stop = plan.parts[robot].plan.stops[0];
    return TeamOrder(plan, 0.7).waits_for(robot, stop.position, stop.waypoints, {&one, &other});
  }
};

TEST(TeamOrder, AWayWaitsForThatWhichCrossesItAndWasAdmittedBefore) {
  Asked asked;
  EXPECT_EQ(asked.waits_for(0), 1U);
  EXPECT_EQ(asked.waits_for(1), std::nullopt);
  asked.other.set_tasks(asked.other.queue(), true);  // its drive has begun
  EXPECT_EQ(asked.waits_for(0), std::nullopt);
  asked.other.set_tasks({});  // or was given up
  EXPECT_EQ(asked.waits_for(0), std::nullopt);
}

TEST(TeamOrder, WaysThatAreFarApartAndStopsThatAreNotPlannedWaitForNobody) {
  Asked asked;
  asked.plan.parts[1].plan.stops[0].waypoints = {{0, -2}, {0, -1}};
  EXPECT_EQ(asked.waits_for(0), std::nullopt);
  Asked elsewhere;
  EXPECT_EQ(TeamOrder(elsewhere.plan, 0.7)
                .waits_for(0, {1, 1}, {{-2, 0}, {1, 1}}, {&elsewhere.one, &elsewhere.other}),
            std::nullopt);
}

}  // namespace
}  // namespace outrider
