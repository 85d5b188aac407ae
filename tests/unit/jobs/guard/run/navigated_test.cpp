// Guard missions of a robot that its navigator drives, among things that no map has.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/jobs/guard/job.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/random_yard.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

/// A street of 40 m with three targets so far apart that the robot has to drive to two of them.
GuardScenario street(const std::string& things) {
  GuardScenario scenario;
  GuardProblem& problem = scenario.problem;
  problem.world.name = "street";
  problem.world.bounds = {{-1, -4}, {41, 4}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{0, 0}, 0.0};
  problem.targets = {{"near", {2, 2, 0}, {0.5, 0.3, 0.45}},
                     {"middle", {20.0, -2.4, 0}, {0.5, 0.3, 0.45}},
                     {"far", {38.0, 2, 0}, {0.5, 0.3, 0.45}}};
  scenario.options.resolution_m = 0.5;
  scenario.options.stops = 30;
  scenario.options.refinements = 0;
  scenario.options.iterations = 50;
  scenario.sim = "navigator";
  scenario.things = things;
  return scenario;
}

Run guarded(const GuardScenario& scenario) {
  GuardJob job;
  job.scenario = scenario;
  Run run;
  const auto done = job.run(run, {});
  EXPECT_TRUE(done) << to_string(done.error());
  return run;
}

std::size_t hits(const Run& run) {
  std::size_t count = 0;
  for (const auto& shot : run.log.messages<outrider_msgs::Shot>(topic::shots))
    count += shot.message.hit ? 1 : 0;
  return count;
}

void expect_all_hit(const Run& run) {
  EXPECT_EQ(run.report.status, "done") << run.report.reason;
  EXPECT_EQ(hits(run), 3U);
  EXPECT_EQ(metric(run.report, "false_reached"), 0.0);
  EXPECT_EQ(metric(run.report, "contacts"), 0.0);
}

TEST(NavigatedGuard, DrivesAsFastAsPlannedWhereNothingStands) {
  const outrider::Run run = guarded(street(""));
  expect_all_hit(run);
  EXPECT_LT(metric(run.report, "mission_s"), 1.1 * metric(run.report, "planned_s"));
  EXPECT_EQ(metric(run.report, "cut_drives"), 0.0);
  // Bounds on drives with turns in place are none on these.
  for (const char* bound : {"lower_bound_s", "gap", "anywhere_lower_bound_s", "anywhere_gap", "tour_proven"})
    EXPECT_TRUE(std::ranges::none_of(run.report.metrics, [&](const auto& m) { return m.first == bound; }))
        << bound;
}

TEST(NavigatedGuard, GoesAroundWhatNoMapHas) {
  const outrider::Run free = guarded(street("")), run = guarded(street("9,0,1,5 27,-0.5,0.8"));
  expect_all_hit(run);
  EXPECT_GT(metric(run.report, "driven_m"), metric(free.report, "driven_m") + 0.5);
}

TEST(NavigatedGuard, ShootsFromElsewhereWhereSomethingStandsAtAStop) {
  const outrider::Run free = guarded(street(""));
  ASSERT_EQ(free.report.status, "done") << free.report.reason;
  const Table& targets = table_named(free.report, "targets");
  const TableRow far{targets, targets.rows[2]};
  const Vec2 stop{far.number("x"), far.number("y")};
  ASSERT_GT(stop.x, 25.0);
  const outrider::Run run = guarded(street(fmt::format("{:.2f},{:.2f},0.3", stop.x, stop.y)));
  expect_all_hit(run);
  EXPECT_GT(metric(run.report, "cut_drives"), 0.0);
  EXPECT_LT(metric(run.report, "mission_s"), metric(free.report, "mission_s") + 60.0);
}

/// A board beside the target stops the balls that were planned, and is in the log as what they touched.
TEST(NavigatedGuard, ShootsFromAsideWhereSomethingStopsItsBalls) {
  const outrider::Run free = guarded(street(""));
  const Table& targets = table_named(free.report, "targets");
  const TableRow far{targets, targets.rows[2]};
  const Vec2 stop{far.number("x"), far.number("y")}, target{38.0, 2.0};
  const Vec2 board = target + 0.5 / distance(stop, target) * (stop - target);
  const outrider::Run run = guarded(street(fmt::format("{:.2f},{:.2f},0.1", board.x, board.y)));
  expect_all_hit(run);
  std::size_t stopped = 0;
  for (const auto& shot : run.log.messages<outrider_msgs::Shot>(topic::shots))
    stopped += shot.message.contact.starts_with("thing") ? 1 : 0;
  EXPECT_GT(stopped, 0U);
}

TEST(NavigatedGuard, PassesPeopleAndIsTheSameTwice) {
  GuardScenario scenario = street("9,0,1,5");
  scenario.navigation.faults.walk_ins.people = 4;
  scenario.navigation.navigator.localiser = "odometry";
  scenario.navigation.wheels.scale_error = 0.0;
  outrider::Run run = guarded(scenario);
  expect_all_hit(run);
  EXPECT_EQ(test::bytes_of_run(run), test::bytes_of_run(guarded(scenario)));
}

/// A robot that does not get away shoots at whom it can from where it is, and says what held it up.
TEST(NavigatedGuard, AndAnyOtherEndsWhereItsWheelsStickWhileIntrudersCome) {
  for (const char* sim : {"navigator", "kinematic"}) {
    GuardScenario scenario = street("");
    scenario.sim = sim;
    scenario.arrivals.count = 8;
    scenario.intruders =
        draw_arrivals(scenario.problem, {{"gate", {20.0, 3.0}}}, scenario.arrivals, 1).value();
    scenario.faults.way.stuck_from_s = 4.0;
    const outrider::Run run = guarded(scenario);
    EXPECT_EQ(run.report.status, "not_done") << sim;
    EXPECT_EQ(metric(run.report, "reached"), static_cast<double>(hits(run))) << sim;
    EXPECT_NE(run.report.reason.find("ended elsewhere than planned"), std::string::npos) << run.report.reason;
    EXPECT_EQ(run.report.reason.find("the gun"), std::string::npos) << run.report.reason;
    EXPECT_LT(metric(run.report, "mission_s"), 600.0) << sim;
  }
}

TEST(NavigatedGuard, AndAnyOtherDrivesOnToIntrudersWhoWalkWhenItsWheelsTurnAgain) {
  for (const char* sim : {"navigator", "kinematic"}) {
    GuardScenario scenario = street("");
    scenario.sim = sim;
    scenario.wander.speed_mps = 0.4;
    scenario.wander.rest_s = 3.0;
    scenario.wander.chance = 0.3;
    scenario.preferences = {1.0, 1.0, 1.0};
    scenario.faults.way.stuck_from_s = 6.0;
    scenario.faults.way.stuck_for_s = 4.0;
    const outrider::Run run = guarded(scenario);
    EXPECT_EQ(run.report.status, "done") << sim << ": " << run.report.reason;
    EXPECT_GT(metric(run.report, "driven_m"), 3.0) << sim;
    EXPECT_LT(metric(run.report, "mission_s"), 300.0) << sim;
  }
}

TEST(NavigatedGuard, RefusesThingsWhereTheRobotStarts) {
  GuardJob job;
  job.scenario = street("0.2,0,1,1");
  outrider::Run run;
  const auto done = job.run(run, {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().where, "things");
}

}  // namespace
}  // namespace outrider
