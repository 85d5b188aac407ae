// Guard missions with faults that they are not told: they end, and call no target reached that no ball hit.
#include <gtest/gtest.h>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/guard_runs.hpp"
#include "support/guard_yard.hpp"

namespace outrider {
namespace {

GuardOptions fault_options(bool on_the_move) {
  GuardOptions options;
  options.resolution_m = 0.25;
  options.stops = 30;
  options.refinements = 0;
  options.iterations = 50;
  options.shoot_on_the_move = on_the_move;
  return options;
}

/// Three targets left and right of a street.
GuardProblem short_street() {
  GuardProblem problem;
  problem.world.bounds = {{-1, -4}, {9, 4}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{0, 0}, 0.0};
  problem.targets = {{"near", {2, 2, 0}, {0.5, 0.3, 0.45}},
                     {"middle", {4.9, -2.4, 0}, {0.5, 0.3, 0.45}},
                     {"far", {7.8, 2, 0}, {0.5, 0.3, 0.45}}};
  return problem;
}

/// Three targets so far apart that the robot has to drive to two of them.
GuardProblem long_street() {
  GuardProblem problem = short_street();
  problem.world.bounds.high.x = 41;
  problem.targets[1].base = {20.0, -2.4, 0};
  problem.targets[2].base = {38.0, 2, 0};
  return problem;
}

struct FaultyRun {
  Run run;
  int hit = 0;  ///< targets that a ball of the log has hit
};

FaultyRun guarded(const GuardSimParams& faults, bool on_the_move,
                  const GuardProblem& problem = short_street()) {
  const GuardOptions options = fault_options(on_the_move);
  const auto firing_map = build_firing_map(problem, options);
  auto plan = plan_guard(problem, *firing_map, fault_options(false), {});
  if (on_the_move) plan = shoot_in_passing(problem, *firing_map, *plan);
  GuardScenario scenario = testing::settings(options, 1);
  scenario.faults = faults;
  FaultyRun done{testing::carried_out(scenario, {problem, *firing_map, *plan}, {})};
  for (const Target& target : problem.targets) {
    bool hit = false;
    for (const auto& shot : done.run.log.messages<outrider_msgs::Shot>(topic::shots))
      hit = hit || (shot.message.hit && shot.message.target == target.name);
    done.hit += hit ? 1 : 0;
  }
  EXPECT_EQ(metric(done.run.report, "reached"), done.hit);
  EXPECT_EQ(metric(done.run.report, "false_reached"), 0.0);
  EXPECT_EQ(done.run.report.status, done.hit == 3 ? "done" : "not_done");
  EXPECT_EQ(done.run.report.reason.empty(), done.hit == 3);
  return done;
}

TEST(GuardFaults, AGunThatIsJammedForGoodEndsTheMission) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.gun.jammed_at_s = 0.0;
    const FaultyRun done = guarded(faults, on_the_move);
    EXPECT_EQ(done.hit, 0);
    EXPECT_EQ(metric(done.run.report, "shots"), 0.0);
    EXPECT_NE(done.run.report.reason.find("is the gun jammed"), std::string::npos) << done.run.report.reason;
  }
}

/// Each of the three targets would be tried 2 x 3 times; the gun is given up long before.
TEST(GuardFaults, AGunThatGivesNoResultIsGivenUp) {
  GunSilence silence;
  for (int shot = 0; shot < 20; ++shot) {
    silence.note(0, false, 10.0 * shot);
    EXPECT_TRUE(silence.verdict(10.0 * shot).empty()) << "one target may be at fault";
  }
  silence.note(1, false, 200.0);
  EXPECT_NE(silence.verdict(200.0).find("21 shots in a row at 2 targets"), std::string::npos);
  silence.note(1, true, 201.0);
  EXPECT_TRUE(silence.verdict(300.0).empty()) << "it shoots";
  for (int shot = 0; shot < 20; ++shot) silence.note(static_cast<std::size_t>(shot), false, 300.0 + shot);
  EXPECT_TRUE(silence.verdict(329.0).empty()) << "a short jam ends by itself";
  EXPECT_FALSE(silence.verdict(330.0).empty());
}

TEST(GuardFaults, AfterAShortJamTargetsAreShotAtAgain) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.gun.jammed_at_s = 0.0;
    faults.gun.jammed_for_s = 2.0;
    EXPECT_EQ(guarded(faults, on_the_move).hit, 3);
  }
}

TEST(GuardFaults, AnEmptyTankLeavesTargets) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.gun.balls = 1;
    const FaultyRun done = guarded(faults, on_the_move);
    EXPECT_EQ(metric(done.run.report, "shots"), 1.0);
    EXPECT_LE(done.hit, 1);
    EXPECT_NE(done.run.report.reason.find("its tank empty"), std::string::npos) << done.run.report.reason;
  }
}

TEST(GuardFaults, LargerErrorsThanToldAreSeen) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.position_ratio = 5.0;
    faults.aim_ratio = 1.9;
    guarded(faults, on_the_move);
  }
}

/// The street is free, so a robot that is held up for a while gets to all its stops.
TEST(GuardFaults, ARobotThatIsPutElsewhereDrivesOnFromThere) {
  for (const bool on_the_move : {false, true}) {
    for (const double at_s : {0.0, 1.0, 2.5, 4.0, 6.0}) {
      GuardSimParams faults;
      faults.way.kidnapping = {at_s, 1.5, 2.0};
      const FaultyRun done = guarded(faults, on_the_move, long_street());
      EXPECT_EQ(done.hit, 3) << at_s;
      EXPECT_EQ(metric(done.run.report, "contacts"), 0.0);
    }
  }
}

TEST(GuardFaults, APostInTheWayIsDrivenAround) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.way.blocked_at_s = 0.0;
    const FaultyRun done = guarded(faults, on_the_move, long_street());
    EXPECT_EQ(done.hit, 3);
    EXPECT_GE(metric(done.run.report, "post_contacts"), 1.0);
    EXPECT_EQ(metric(done.run.report, "contacts"), 0.0);
  }
}

TEST(GuardFaults, APostAtAPlaceIsMetThere) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.way.blocked_at_s = 0.0;
    faults.way.blocked_place = Vec2{10.0, 0.0};
    faults.way.blocked_radius_m = 1.0;
    const FaultyRun done = guarded(faults, on_the_move, long_street());
    EXPECT_EQ(done.hit, 3);
    EXPECT_GE(metric(done.run.report, "post_contacts"), 1.0);
    faults.way.blocked_place = Vec2{10.0, 3.5};  // beside the way
    faults.way.blocked_radius_m = 0.1;
    EXPECT_EQ(metric(guarded(faults, on_the_move, long_street()).run.report, "post_contacts"), 0.0);
  }
}

/// A street with a wall across it, so that ways have to be searched.
GuardProblem walled_street() {
  GuardProblem problem = long_street();
  problem.world.solids.push_back({"wall", {{12.0, -0.5, 0.25}, {}}, BoxShape{{0.2, 2.0, 0.25}}});
  return problem;
}

TEST(GuardFaults, APlannerWithoutABudgetEndsTheMissionWithThatReason) {
  GuardSimParams faults;
  faults.planner.from_s = 0.0;
  const FaultyRun done = guarded(faults, false, walled_street());
  EXPECT_LT(done.hit, 3);
  EXPECT_NE(done.run.report.reason.find("no way can be planned since"), std::string::npos)
      << done.run.report.reason;
  EXPECT_LT(metric(done.run.report, "mission_s"), 200.0);
}

TEST(GuardFaults, AfterAPlannerWithoutABudgetItGoesOn) {
  GuardSimParams faults;
  faults.planner = {0.0, 20.0};
  const FaultyRun done = guarded(faults, false, walled_street());
  EXPECT_EQ(done.hit, 3);
  EXPECT_GT(metric(done.run.report, "mission_s"), 20.0);
}

TEST(GuardFaults, WheelsThatStickForAWhileDelayTheMission) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.way.stuck_from_s = 1.0;
    faults.way.stuck_for_s = 8.0;
    EXPECT_EQ(guarded(faults, on_the_move, long_street()).hit, 3);
  }
}

TEST(GuardFaults, WheelsThatStickForGoodAreTold) {
  for (const bool on_the_move : {false, true}) {
    GuardSimParams faults;
    faults.way.stuck_from_s = 1.0;
    const FaultyRun done = guarded(faults, on_the_move, long_street());
    EXPECT_LT(done.hit, 3);
    EXPECT_NE(done.run.report.reason.find("do its wheels stick"), std::string::npos)
        << done.run.report.reason;
    EXPECT_LT(metric(done.run.report, "mission_s"), 300.0);
  }
}

}  // namespace
}  // namespace outrider
