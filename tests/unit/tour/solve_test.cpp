#include "outrider/tour/solve.hpp"

#include <gtest/gtest.h>

#include "brute_force.hpp"
#include "random_tour.hpp"
#include "support/costly_cases.hpp"

namespace outrider {
namespace {

TourOptions heuristic(std::int64_t iterations) {
  TourOptions options;
  options.exact_goals = 0;
  options.iterations = iterations;
  options.gap = 1.0;
  return options;
}

Budget expansions_only(std::uint64_t expansions) {
  Budget budget;
  budget.expansions = expansions;
  return budget;
}

TourOptions exact_without_help() {
  TourOptions options;
  options.iterations = 0;
  return options;
}

Tour solved(const TourProblem& problem, const TourOptions& options) {
  auto tour = solve(problem, options, {});
  EXPECT_TRUE(tour) << tour.error().sentence;
  const Status judged = check(problem, *tour);
  EXPECT_TRUE(judged) << judged.error().sentence;
  return *tour;
}

/// One goal ahead, one stop on the way to it, the numbers simple.
TourProblem one_goal() {
  TourProblem problem;
  problem.goals = 1;
  problem.turning = {1.0, std::numeric_limits<double>::infinity()};
  problem.services = {{}, {{0, pi / 2.0, 0.5, 2.0}}};
  problem.drives.resize(4);
  problem.drives[1] = {3.0, 1.0, 0.5};
  return problem;
}

TEST(Cost, FollowsTheModelByHand) {
  TourProblem problem = one_goal();
  const double turn = 1.0;
  const double yaw = pi / 2.0 - 0.5;
  EXPECT_NEAR(cost(problem, {{1, {0}}}), turn + 3.0 + yaw + 2.0, 1e-12);
  problem.pitch_rate_radps = 0.1;
  EXPECT_NEAR(cost(problem, {{1, {0}}}), turn + 3.0 + 5.0 + 2.0, 1e-12);
  EXPECT_EQ(cost(problem, {}), 0.0);
  EXPECT_EQ(cost(problem, {{0, {0}}}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(cost(problem, {{7, {0}}}), std::numeric_limits<double>::infinity());
}

TEST(Solve, MoreRoundsThanATourNeedsAreNotTried) {
  const TourProblem problem = one_goal();
  const Tour tour = solved(problem, heuristic(1'000'000'000));
  EXPECT_EQ(tour.iterations, 10'000U * problem.goals);
}

TEST(Cost, TheGunKeepsItsPlaceOnTheBodyWhileItTurns) {
  TourProblem problem = one_goal();
  problem.goals = 2;
  problem.services[0] = {{1, 1.0, 0.0, 0.0}};  // yaw 1 relative to the body from now on
  problem.services[1] = {{0, 1.5, 0.0, 0.0}};  // heading 0.5 there: the gun points right already
  EXPECT_NEAR(cost(problem, {{0, {1}}, {1, {0}}}), 1.0 + (1.0 + 3.0), 1e-12);
}

TEST(Cost, ADriveOfNoTimeLeavesTheHeading) {
  TourProblem problem = one_goal();
  problem.drives[1] = {0.0, 3.0, 3.0};
  EXPECT_NEAR(cost(problem, {{1, {0}}}), pi / 2.0 + 2.0, 1e-12);
}

TEST(Solve, ExactEqualsBruteForce) {
  for (std::uint64_t seed = 0; seed < 2500; ++seed) {
    const std::size_t goals = 1 + seed % 4;
    const TourProblem problem =
        seed % 2 == 0 ? random_table(goals, 1 + seed % 3, seed) : random_yard(goals, 1 + seed % 4, 3, seed);
    const Tour tour = solved(problem, exact_without_help());
    EXPECT_TRUE(tour.proven_optimal);
    ASSERT_NEAR(tour.cost_s, brute_force(problem), 1e-6) << "seed " << seed;
  }
}

TEST(Solve, ExactEqualsBruteForceWithFiveGoals) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const TourProblem problem = seed % 2 == 0 ? random_table(5, 3, seed) : random_yard(5, 5, 3, seed);
    ASSERT_NEAR(solved(problem, exact_without_help()).cost_s, brute_force(problem), 1e-6) << "seed " << seed;
  }
}

TEST(Solve, SearchIsNeverBelowTheOptimumAndNearIt) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const TourProblem problem = random_yard(5 + seed % 6, 10 + seed % 30, 5, seed);
    const Tour best = solved(problem, {});
    ASSERT_TRUE(best.proven_optimal);
    const Tour found = solved(problem, heuristic(2000));
    EXPECT_GE(found.cost_s, best.cost_s - 1e-6);
    EXPECT_LE(found.cost_s, 1.03 * best.cost_s) << "seed " << seed;
    EXPECT_LE(found.lower_bound_s, best.cost_s + 1e-6) << "seed " << seed;
    sum += found.cost_s / best.cost_s;
  }
  EXPECT_LE(sum / 60.0, 1.002);
}

TEST(Solve, LowerBoundsHold) {
  const auto seeds = static_cast<std::uint64_t>(testing::costly_cases(150));
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const TourProblem problem = seed % 2 == 0 ? random_table(2 + seed % 4, 2 + seed % 5, seed)
                                              : random_yard(3 + seed % 6, 12, 4, seed);
    const double optimum = solved(problem, {}).cost_s;
    for (const std::int64_t expansions : {0, 1, 3, 10, 30}) {
      TourOptions options = exact_without_help();
      options.expansions = expansions;
      EXPECT_LE(solved(problem, options).lower_bound_s, optimum + 1e-6) << "seed " << seed;
    }
  }
}

TEST(Solve, ProvesTwelveGoalsAmongSixtyStops) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Tour tour = solved(random_yard(12, 60, 6, seed), {});
    EXPECT_TRUE(tour.proven_optimal);
    EXPECT_LE(tour.expansions, 100'000U);
  }
}

TEST(Solve, ManyGoalsEndNearALongSearch) {
  const TourProblem problem = random_yard(24, 120, 8, 4);
  const double brief = solved(problem, heuristic(16'000)).cost_s;
  const double thorough = solved(problem, heuristic(60'000)).cost_s;
  EXPECT_LE(brief, 1.02 * thorough);
}

TEST(Solve, MoreThanSixtyFourGoals) {
  const Tour tour = solved(random_yard(90, 60, 9, 5), heuristic(200));
  EXPECT_FALSE(tour.proven_optimal);
}

TEST(Solve, SameInputSameTour) {
  const TourProblem problem = random_yard(20, 60, 6, 9);
  const Tour once = solved(problem, heuristic(1500));
  const Tour twice = solved(problem, heuristic(1500));
  EXPECT_EQ(once.visits, twice.visits);
  EXPECT_EQ(once.cost_s, twice.cost_s);
  EXPECT_EQ(once.lower_bound_s, twice.lower_bound_s);
}

TEST(Solve, NothingToServe) {
  TourProblem problem;
  problem.services.resize(1);
  problem.drives.resize(1);
  const Tour tour = solved(problem, {});
  EXPECT_TRUE(tour.visits.empty());
  EXPECT_TRUE(tour.proven_optimal);
  EXPECT_EQ(tour.cost_s, 0.0);
}

TEST(Solve, StartServesAll) {
  TourProblem problem = one_goal();
  problem.services[0] = {{0, 0.3, 0.0, 1.0}};
  problem.services.resize(1);
  problem.drives.resize(1);
  const Tour tour = solved(problem, {});
  EXPECT_NEAR(tour.cost_s, 1.3, 1e-12);
  EXPECT_EQ(tour.visits, (std::vector<Visit>{{0, {0}}}));
}

TEST(Solve, GoalOnlyServedAtAStartWithoutAWayBack) {
  TourProblem problem = one_goal();
  problem.goals = 2;
  problem.services[0] = {{1, 3.0, 0.0, 5.0}};
  problem.drives[2].time_s = std::numeric_limits<double>::infinity();
  for (const TourOptions& options : {TourOptions{}, heuristic(50)}) {
    EXPECT_EQ(solved(problem, options).visits, (std::vector<Visit>{{0, {1}}, {1, {0}}}));
  }
}

TEST(Solve, SaysWhichGoalCannotBeServed) {
  TourProblem problem = one_goal();
  problem.drives[1].time_s = std::numeric_limits<double>::infinity();
  const auto tour = solve(problem, {}, {});
  ASSERT_FALSE(tour);
  EXPECT_EQ(tour.error().code, FaultCode::no_path);
  EXPECT_NE(tour.error().sentence.find("goal 0"), std::string::npos);
}

TEST(Solve, BudgetEndsWithAWholeTourOrARefusal) {
  const TourProblem problem = random_yard(14, 40, 5, 3);
  EXPECT_EQ(solve(problem, {}, expansions_only(0)).error().code, FaultCode::budget_exhausted);
  for (const std::uint64_t expansions : {1U, 2U, 50U, 500U, 2500U}) {
    for (const std::int64_t exact_goals : {0, 16}) {
      TourOptions options;
      options.exact_goals = exact_goals;
      const auto tour = solve(problem, options, expansions_only(expansions));
      ASSERT_TRUE(tour);
      EXPECT_TRUE(tour->ended_early);
      EXPECT_FALSE(tour->proven_optimal);
      EXPECT_TRUE(check(problem, *tour));
    }
  }
}

TEST(Solve, CancelledBeforeItBegan) {
  std::stop_source source;
  source.request_stop();
  Budget budget;
  budget.stop = source.get_token();
  const auto tour = solve(random_yard(6, 10, 3, 1), {}, budget);
  ASSERT_FALSE(tour);
  EXPECT_EQ(tour.error().code, FaultCode::cancelled);
}

TEST(Solve, WallTimeEndsItWithAWholeTour) {
  Budget budget;
  budget.wall_time = std::chrono::milliseconds(30);
  const TourProblem problem = random_yard(24, 60, 6, 2);
  const auto tour = solve(problem, heuristic(1'000'000'000), budget);
  ASSERT_TRUE(tour);
  EXPECT_TRUE(tour->ended_early);
  EXPECT_TRUE(check(problem, *tour));
}

TEST(Solve, RefusesOptionsOutOfRange) {
  TourOptions options;
  options.gap = 1.5;
  EXPECT_EQ(solve(one_goal(), options, {}).error().code, FaultCode::bad_input);
  EXPECT_EQ(solve(one_goal(), heuristic(-1), {}).error().code, FaultCode::bad_input);
}

TEST(Solve, DescribesItsOptions) {
  TourOptions options;
  for (const Option& option : describe(options)) {
    EXPECT_TRUE(assign(option, value_text(option))) << option.name;
  }
  EXPECT_EQ(describe(options).size(), 6U);
}

}  // namespace
}  // namespace outrider
