#include "outrider/jobs/pursue/run.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "outrider/pursuit/optimal.hpp"
#include "support/costly_cases.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// A clock on which every lap takes the next of the given times, again and again.
class ToldWatch : public StopWatch {
 public:
  explicit ToldWatch(std::vector<double> laps = {0.0}) : laps_(std::move(laps)) {}
  double lap_s() override { return laps_[next_++ % laps_.size()]; }
  void restart() override {}

 private:
  std::vector<double> laps_;
  std::size_t next_ = 0;
};

PursuitRun run(const PursuitProblem& problem, const PursuitRules& rules, std::vector<double> laps = {0.0},
               std::vector<Cell> robots = {}) {
  ToldWatch watch(std::move(laps));
  if (robots.empty()) robots = {problem.start};
  auto done = pursue(problem, robots, rules, watch);
  EXPECT_TRUE(done) << to_string(done.error());
  return done ? std::move(*done) : PursuitRun{};
}

/// A random pursuit from second 0 that has a catch.
PursuitProblem catchable(Rng& rng, int side, int seconds) {
  for (;;) {
    PursuitProblem problem = testing::random_pursuit(rng, side, seconds);
    problem.start_s = 0;
    if (testing::slow_catch(problem)) return problem;
  }
}

/// Counts what the reference's test bench would count along the robot's path.
void expect_honest(const PursuitState& mission, const PursuitProblem& problem) {
  const std::vector<Cell>& path = mission.paths.front();
  ASSERT_EQ(path.size(), static_cast<std::size_t>(mission.time_s) + 1);
  std::uint64_t cost = 0;
  for (std::size_t s = 1; s < path.size(); ++s) {
    cost += (*problem.costs)[path[s - 1]];
    EXPECT_LE(std::max(std::abs(path[s].x - path[s - 1].x), std::abs(path[s].y - path[s - 1].y)), 1);
    EXPECT_FALSE(problem.wall(path[s]));
    EXPECT_EQ(path[s] == problem.target[s], mission.caught && s + 1 == path.size());
  }
  EXPECT_EQ(cost, mission.cost);
}

TEST(PursuitRun, FreePlanningIsOptimalAndHonest) {
  Rng rng(1);
  for (int k = 0; k < testing::cases(300); ++k) {
    const PursuitProblem problem = catchable(rng, 7, 16);
    const PursuitRun done = run(problem, {});
    const auto truth = testing::slow_catch(problem);
    EXPECT_TRUE(done.state.caught);
    EXPECT_EQ(done.state.cost, truth->cost);
    EXPECT_EQ(done.lower_bound, truth->cost);
    EXPECT_EQ(done.earliest_catch_s, truth->earliest_s);
    expect_honest(done.state, problem);
  }
}

TEST(PursuitRun, ThinkingForLessThanTwoSecondsCostsNothing) {
  Rng rng(2);
  for (int k = 0; k < testing::cases(200); ++k) {
    const PursuitProblem problem = catchable(rng, 7, 16);
    PursuitRules rules;
    rules.clock = PursuitClock::wall;
    rules.ask = [](const PursuitProblem& asked, const Budget& budget) {
      Workspace workspace;
      return optimal_pursuit(asked, {}, budget, workspace);
    };
    EXPECT_EQ(run(problem, rules, {1.999}).state.cost, testing::slow_catch(problem)->cost);
  }
}

TEST(PursuitRun, SlowThinkingIsPaidForAndStillHonest) {
  Rng rng(3);
  int caught = 0;
  for (int k = 0; k < testing::cases(300); ++k) {
    const PursuitProblem problem = catchable(rng, 7, 24);
    PursuitRules rules;
    rules.clock = PursuitClock::wall;
    rules.ask = [](const PursuitProblem& asked, const Budget& budget) {
      Workspace workspace;
      return optimal_pursuit(asked, {}, budget, workspace);
    };
    const PursuitRun done = run(problem, rules, {3.5});
    expect_honest(done.state, problem);
    if (!done.state.caught) continue;
    ++caught;
    EXPECT_GE(done.state.cost, testing::slow_catch(problem)->cost);
  }
  EXPECT_GT(caught, 50);
}

TEST(PursuitRun, TheFirstLateAnswerIsAskedAgainFromFurtherAhead) {
  // 4 s of thinking: three seconds of waiting, one more in which the stale answer is dropped; then the
  // question is about a place 4 s ahead, and its answer is there in time.
  const auto problem = testing::drawn_pursuit({"2111"}, {0, 0}, std::vector<Cell>(30, Cell{3, 0}));
  PursuitRules rules;
  rules.clock = PursuitClock::wall;
  rules.ask = [](const PursuitProblem& asked, const Budget& budget) {
    Workspace workspace;
    return optimal_pursuit(asked, {}, budget, workspace);
  };
  const PursuitRun done = run(problem, rules, {4.0});
  EXPECT_TRUE(done.state.caught);
  expect_honest(done.state, problem);
}

TEST(PursuitRun, ImprovementsNeverMakeItWorse) {
  Rng rng(4);
  for (int k = 0; k < testing::cases(150); ++k) {
    const PursuitProblem problem = catchable(rng, 10, 40);
    PursuitRules rules;
    rules.clock = PursuitClock::wall;
    rules.call_s = 0.5;
    rules.budget.expansions = 5;  // very little in a call, so that many are needed
    const PursuitRun done = run(problem, rules, {0.6});
    expect_honest(done.state, problem);
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (const PursuitMoment& moment : done.moments) {
      if (!moment.cost || done.calls == 0) continue;
      EXPECT_LE(*moment.cost, least) << "the catch under way became dearer";
      least = *moment.cost;
    }
  }
}

TEST(PursuitRun, KnowingEverySecondIsKnowingAll) {
  Rng rng(6);
  for (int k = 0; k < testing::cases(100); ++k) {
    const PursuitProblem problem = catchable(rng, 7, 16);
    PursuitRules rules;
    rules.known_s = problem.last_s();
    EXPECT_EQ(run(problem, rules).state.cost, testing::slow_catch(problem)->cost);
  }
}

/// A target that walks a while in one direction, on a map without walls; the robot can always catch it.
PursuitProblem walk(Rng& rng) {
  const int side = 24;
  GridFrame frame;
  frame.width = frame.height = side;
  CostGrid costs(frame);
  for (std::uint32_t& cost : costs.cells) cost = 1 + static_cast<std::uint32_t>(rng.below(9));
  PursuitProblem problem;
  problem.costs = std::make_shared<const CostGrid>(std::move(costs));
  problem.threshold = 100;
  problem.start = {0, 0};
  Cell at{12, 12}, way{1, 0};
  for (int s = 0; s < 80; ++s) {
    problem.target.push_back(at);
    if (rng.below(6) == 0) way = {static_cast<int>(rng.below(3)) - 1, static_cast<int>(rng.below(3)) - 1};
    at = {std::clamp(at.x + way.x, 0, side - 1), std::clamp(at.y + way.y, 0, side - 1)};
  }
  return problem;
}

TEST(PursuitRun, MoreKnowledgeIsNeverWorseOnAverage) {
  for (const TargetForecast& forecast : target_forecasts()) {
    double before = std::numeric_limits<double>::infinity();
    for (const int known_s : {0, 4, 16, 80}) {
      Rng rng(7);
      double sum = 0.0;
      const int runs = testing::costly_cases(60);
      for (int k = 0; k < runs; ++k) {
        const PursuitProblem problem = walk(rng);
        PursuitRules rules;
        rules.known_s = known_s;
        rules.forecast = forecast;
        const PursuitRun done = run(problem, rules);
        expect_honest(done.state, problem);
        // Without a catch all was paid for nothing: as if the worst cell had been paid throughout.
        sum += done.state.caught ? static_cast<double>(done.state.cost) : 9.0 * 80.0;
      }
      if (testing::in_full()) {
        EXPECT_LE(sum, before) << forecast.name << ", " << known_s << " s known";
      }
      before = sum;
    }
  }
}

TEST(PursuitRun, MorePursuersAreNeverLaterNorDearer) {
  Rng rng(8);
  for (int k = 0; k < testing::cases(100); ++k) {
    const PursuitProblem problem = catchable(rng, 8, 20);
    const std::vector<Cell> team = place_team(problem, 4);
    EXPECT_EQ(team.front(), problem.start);
    std::uint64_t cost = std::numeric_limits<std::uint64_t>::max();
    int earliest_s = std::numeric_limits<int>::max();
    std::uint64_t least = cost;
    for (std::size_t count = 1; count <= team.size(); ++count) {
      PursuitProblem alone = problem;
      alone.start = team[count - 1];
      ASSERT_FALSE(problem.wall(alone.start));
      if (const auto truth = testing::slow_catch(alone)) least = std::min(least, truth->cost);
      const PursuitRun done =
          run(problem, {}, {0.0}, {team.begin(), team.begin() + static_cast<std::ptrdiff_t>(count)});
      EXPECT_TRUE(done.state.caught);
      EXPECT_EQ(done.state.cost, least);
      EXPECT_EQ(done.lower_bound, least);
      EXPECT_LE(done.state.cost, cost);
      EXPECT_LE(done.earliest_catch_s, earliest_s);
      EXPECT_EQ(done.state.handovers, 0);
      cost = done.state.cost;
      earliest_s = done.earliest_catch_s;
    }
  }
}

TEST(PursuitRun, WhatCannotBeCaughtIsSaidAtTheStart) {
  const auto problem = testing::drawn_pursuit({"1#1"}, {0, 0}, {{2, 0}, {2, 0}, {2, 0}});
  ToldWatch watch;
  const auto refused = pursue(problem, {problem.start}, {}, watch);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, FaultCode::no_path);
  const auto blocked = pursue(problem, {problem.start, {1, 0}}, {}, watch);
  ASSERT_FALSE(blocked);
  EXPECT_EQ(blocked.error().code, FaultCode::start_blocked);
}

}  // namespace
}  // namespace outrider
