// Pursuits by a robot on wheels: caught only if the robot truly is in the target's cell, and without a
// contact.
#include "outrider/jobs/pursue/navigated.hpp"

#include <gtest/gtest.h>

#include "outrider/jobs/pursue/report.hpp"
#include "outrider/jobs/pursue/scenario.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct FreePlanning final : StopWatch {
  double lap_s() override { return 0.0; }
  void restart() override {}
};

/// A yard of 14 x 9 cells with a hedge, in which the target walks to and fro along the right edge.
PursuitProblem hedged_yard() {
  std::vector<std::string> rows(9, "11111111111111");
  for (std::size_t y = 2; y < 7; ++y) rows[y][5] = '#';
  std::vector<Cell> target;
  for (int s = 0; s < 120; ++s) {
    const int phase = s / 2 % 16;
    target.push_back({12, phase < 8 ? phase : 16 - phase});
  }
  return testing::drawn_pursuit(rows, {0, 4}, target);
}

struct Driven {
  PursuitRun run;
  Report report;
  Pose2 end;
};

Driven driven(const PursuitProblem& problem, const PursuerOptions& options = {}, std::uint64_t seed = 1) {
  auto robot = NavigatedPursuer::make(problem, options, static_cast<int>(problem.target.size()), seed);
  if (!robot) throw std::runtime_error(to_string(robot.error()));
  FreePlanning watch;
  PursuitRules rules;
  auto run = pursue(problem, rules, *robot, watch);
  if (!run) throw std::runtime_error(to_string(run.error()));
  Driven done{std::move(*run), {}, robot->body().pose()};
  done.report = pursuit_report(problem, done.run, robot->body(), "yard");
  return done;
}

/// The verdict is that of the true pose.
void expect_honest(const PursuitProblem& problem, const Driven& done) {
  const auto now_s = static_cast<std::size_t>(done.run.state.time_s);
  const bool there = problem.costs->frame.cell_at(done.end.position) == problem.target[now_s];
  EXPECT_TRUE(there || done.report.status == "not_done");
  EXPECT_EQ(metric(done.report, "contacts"), 0.0);
}

TEST(NavigatedPursuit, CatchesAtLittleMoreThanStepsDo) {
  const PursuitProblem problem = hedged_yard();
  const Driven done = driven(problem);
  expect_honest(problem, done);
  EXPECT_EQ(done.report.status, "done") << done.report.reason;
  FreePlanning watch;
  const auto steps = pursue(problem, {problem.start}, {}, watch);
  ASSERT_TRUE(steps.has_value());
  EXPECT_LE(done.run.state.cost, 2 * steps->state.cost);
}

TEST(NavigatedPursuit, GoesAroundWhatTheMapDoesNotHave) {
  const PursuitProblem problem = hedged_yard();
  PursuerOptions options;
  options.things = "3.5,1.2,0.3 3.5,7.5,0.5 9.5,4.5,1,3";
  const Driven done = driven(problem, options);
  expect_honest(problem, done);
  EXPECT_EQ(done.report.status, "done") << done.report.reason;
}

/// Two walls that meet at a corner leave a disk no way between them.
TEST(NavigatedPursuit, DoesNotSqueezeBetweenWallsThatMeetAtACorner) {
  const std::vector<std::string> rows = {"11111#1", "1111#11", "111#111", "11#1111", "1111111"};
  const PursuitProblem problem = testing::drawn_pursuit(rows, {0, 4}, std::vector<Cell>(60, Cell{6, 4}));
  const Driven done = driven(problem);
  expect_honest(problem, done);
  EXPECT_EQ(done.report.status, "done") << done.report.reason;
  EXPECT_GT(done.run.state.moves, 6) << "around the end of the wall";
}

TEST(NavigatedPursuit, GivesUpWhatIsBehindThings) {
  const std::vector<std::string> rows = {"###", "111", "#1#", "#1#"};
  const PursuitProblem problem = testing::drawn_pursuit(rows, {1, 0}, std::vector<Cell>(40, Cell{0, 2}));
  PursuerOptions options;
  options.things = "1.5,1.9,0.4";
  const Driven done = driven(problem, options);
  expect_honest(problem, done);
  EXPECT_EQ(done.report.status, "not_done");
  EXPECT_FALSE(done.report.reason.empty());
}

TEST(NavigatedPursuit, IsHonestInRandomYards) {
  Rng rng(5);
  int caught = 0, possible = 0;
  for (int i = 0; i < testing::cases(6); ++i) {
    PursuitProblem problem = testing::random_pursuit(rng, 12, 60);
    problem.start_s = 0;
    if (!testing::slow_catch(problem) || problem.wall(problem.start)) continue;
    ++possible;
    const Driven done = driven(problem, {}, static_cast<std::uint64_t>(i));
    expect_honest(problem, done);
    if (done.report.status == "done") ++caught;
  }
  EXPECT_GE(2 * caught, possible);
}

TEST(NavigatedPursuit, IsTheSameEachTime) {
  const PursuitProblem problem = hedged_yard();
  PursuerOptions options;
  options.navigation.faults.walk_ins.people = 2;
  const Driven one = driven(problem, options, 3), other = driven(problem, options, 3);
  EXPECT_EQ(one.run.state.paths, other.run.state.paths);
  EXPECT_EQ(one.end.position, other.end.position);
}

TEST(NavigatedPursuit, RefusesWhatDoesNotGoTogether) {
  PursuitScenario scenario;
  scenario.map = "none.txt";
  scenario.pursuer.things = "1,1,0.2";
  EXPECT_EQ(load_task(scenario).error().where, "things");
  scenario.sim = "navigator";
  scenario.pursuers = 2;
  EXPECT_EQ(load_task(scenario).error().where, "pursuers");
  scenario.pursuers = 1;
  scenario.faults.missed = 0.5;
  scenario.known = 3;
  EXPECT_EQ(load_task(scenario).error().where, "faults");
  PursuerOptions options;
  options.things = "0.5,4.5,0.3";
  const PursuitProblem problem = hedged_yard();
  EXPECT_EQ(NavigatedPursuer::make(problem, options, 1, 1).error().where, "things");
  options.things.clear();
  options.robot.radius_m = 0.6;
  EXPECT_FALSE(NavigatedPursuer::make(testing::drawn_pursuit({"###", "#1#", "###"}, {1, 1}, {{1, 1}, {1, 1}}),
                                      options, 1, 1));
}

}  // namespace
}  // namespace outrider
