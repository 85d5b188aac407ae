#include "outrider/tour/supply/supply.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "outrider/tour/solve.hpp"
#include "random_supply.hpp"
#include "supply_programme.hpp"
#include "support/costly_cases.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// The judge's verdict on a tour: it can be done, takes what it says, and serves each goal once or drops it.
void expect_sound(const SupplyProblem& problem, const SupplyTour& tour) {
  const auto after = levels(problem, tour.steps);
  ASSERT_TRUE(after) << after.error().sentence;
  if (!after->empty()) {
    EXPECT_NEAR(after->back().time_s, tour.cost_s, 1e-9);
  }
  std::vector<int> times(problem.table.goals, 0);
  for (const SupplyStep& step : tour.steps) {
    EXPECT_EQ(step.station.has_value(), step.goals.empty());
    for (const std::uint32_t goal : step.goals) ++times.at(goal);
  }
  for (const std::uint32_t goal : tour.dropped) ++times.at(goal);
  EXPECT_EQ(std::ranges::count(times, 1), std::ssize(times));
}

TEST(Supply, WithoutEndIsTheTourOfTheTable) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SupplyProblem problem = random_supply(5, 5, seed);
    problem.water = problem.charge = std::numeric_limits<double>::infinity();
    problem.stations.clear();
    const auto tour = solve_supplied(problem, {}, {});
    ASSERT_TRUE(tour) << tour.error().sentence;
    EXPECT_TRUE(tour->proven_optimal);
    EXPECT_NEAR(tour->cost_s, solve(problem.table, {}, {})->cost_s, 1e-6);
  }
}

TEST(Supply, ExactSearchIsTheLeastOfAllSequences) {
  int possible = 0;
  int impossible = 0;
  for (int i = 0; i < testing::costly_cases(150); ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const SupplyProblem problem = random_supply(2 + seed % 2, 3, seed);
    const auto tour = solve_supplied(problem, {.iterations = 20}, {});
    ASSERT_TRUE(tour) << tour.error().sentence;
    expect_sound(problem, *tour);
    const double least = brute_force(problem, 3);
    EXPECT_EQ(tour->proven_too_much, std::isinf(least)) << seed;
    EXPECT_EQ(tour->proven_optimal, std::isfinite(least)) << seed;
    (std::isfinite(least) ? possible : impossible) += 1;
    if (std::isfinite(least)) {
      EXPECT_NEAR(tour->cost_s, least, 1e-6) << seed;
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(possible, 60);
  EXPECT_GT(impossible, 10);
}

TEST(Supply, ProgrammeAndSearchAgree) {
  if (!supply_programme_is_available()) GTEST_SKIP() << "built without CBC";
  int possible = 0;
  for (int i = 0; i < testing::cases(6); ++i) {
    const auto seed = static_cast<std::uint64_t>(1000 + i);
    const SupplyProblem problem = random_supply(2 + seed % 2, 3, seed);
    const auto own = solve_supplied(problem, {.iterations = 50}, {});
    const auto programme = solve_by_programme(problem);
    ASSERT_TRUE(own) << own.error().sentence;
    ASSERT_EQ(programme.has_value(), own->proven_optimal)
        << seed << ": " << (programme ? "" : programme.error().sentence);
    if (!programme) {
      EXPECT_EQ(programme.error().code, FaultCode::no_path);
      EXPECT_TRUE(own->proven_too_much);
      continue;
    }
    ++possible;
    expect_sound(problem, programme->tour);
    EXPECT_TRUE(programme->tour.proven_optimal);
    EXPECT_NEAR(programme->tour.cost_s, own->cost_s, 1e-5) << seed;
    EXPECT_NEAR(programme->objective_s, own->cost_s, 1e-4) << seed;
  }
  EXPECT_GT(possible, 2);
}

TEST(Supply, RuinAndRecreateIsCloseToTheOptimum) {
  double sum = 0.0;
  int compared = 0;
  for (int i = 0; i < testing::cases(25); ++i) {
    const SupplyProblem problem = random_supply(6, 8, static_cast<std::uint64_t>(2000 + i));
    const auto exact = solve_supplied(problem, {}, {});
    const auto search = solve_supplied(problem, {.exact_goals = 0}, {});
    ASSERT_TRUE(exact && search);
    expect_sound(problem, *search);
    EXPECT_FALSE(search->proven_optimal);
    if (!exact->proven_optimal) continue;
    EXPECT_TRUE(search->dropped.empty()) << i;
    const double above = search->cost_s / exact->cost_s - 1.0;
    EXPECT_GE(above, -1e-9) << i;
    EXPECT_LE(above, 0.15) << i;
    sum += above;
    ++compared;
  }
  EXPECT_GT(compared, 10);
  EXPECT_LT(sum / compared, 0.02);
}

TEST(Supply, ManyGoalsAreServedSoundlyAndTwiceTheSame) {
  const SupplyProblem problem = random_supply(30, 40, 3);
  const auto tour = solve_supplied(problem, {.iterations = 200}, {});
  ASSERT_TRUE(tour) << tour.error().sentence;
  expect_sound(problem, *tour);
  EXPECT_EQ(solve_supplied(problem, {.iterations = 200}, {})->steps, tour->steps);
}

/// Two stops 10 m apart on a line, a goal at each, a station at the start.
SupplyProblem line() {
  SupplyProblem problem;
  problem.table.goals = 2;
  problem.table.turning = {1.0, 1.0};
  problem.table.services = {{}, {{0, 0.0, 0.0, 1.0}}, {{1, 0.0, 0.0, 1.0}}, {}};
  const double at[] = {0.0, 10.0, 20.0, 0.0};
  for (const double a : at) {
    for (const double b : at) {
      const double heading = b < a ? pi : 0.0;
      problem.table.drives.push_back({std::abs(a - b), heading, heading});
      problem.lengths_m.push_back(std::abs(a - b));
    }
  }
  return problem;
}

TEST(Supply, LevelsAreWhatTheModelSays) {
  SupplyProblem problem = line();
  problem.water = 1.0;
  problem.stations = {{3, Store::water, 5.0, 2.0}};
  const double half_turn = duration(pi, problem.table.turning);
  const auto after = levels(problem, {{1, {0}, {}}, {3, {}, 0}, {2, {1}, {}}});
  ASSERT_TRUE(after) << after.error().sentence;
  EXPECT_DOUBLE_EQ((*after)[0].water, 0.0);
  EXPECT_DOUBLE_EQ((*after)[0].time_s, 11.0);
  EXPECT_DOUBLE_EQ((*after)[1].filling_s, 7.0);
  EXPECT_DOUBLE_EQ((*after)[1].water, 1.0);
  EXPECT_NEAR((*after)[1].time_s, 11.0 + half_turn + 10.0 + 7.0, 1e-9);
  const auto best = solve_supplied(problem, {}, {});
  ASSERT_TRUE(best);
  EXPECT_TRUE(best->proven_optimal);
  EXPECT_NEAR(best->cost_s, (*after)[2].time_s, 1e-9);
}

TEST(Supply, StrandsNobody) {
  SupplyProblem problem = line();
  problem.charge_per_metre = 1.0;
  problem.stations = {{3, Store::charge, 0.0, 0.0}};
  problem.charge = 40.0;  // there and back
  EXPECT_TRUE(solve_supplied(problem, {}, {})->proven_optimal);
  problem.charge = 39.0;
  const auto tour = solve_supplied(problem, {}, {});
  EXPECT_TRUE(tour->proven_too_much);
  EXPECT_EQ(tour->dropped, std::vector<std::uint32_t>{1});
  const auto refused = levels(problem, {{2, {1}, {}}});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("to get to a charger"), std::string::npos);
  problem.stations.clear();  // nowhere to get to
  EXPECT_TRUE(solve_supplied(problem, {}, {})->proven_optimal);
}

TEST(Supply, RefusesWhatIsWrong) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(SupplyProblem&)>> corruptions = {
      [](SupplyProblem& p) { p.table.goals = 9; },
      [](SupplyProblem& p) { p.lengths_m.pop_back(); },
      [](SupplyProblem& p) { p.lengths_m[1] = -1.0; },
      [](SupplyProblem& p) { p.water = 0.0; },
      [](SupplyProblem& p) { p.charge = nan; },
      [](SupplyProblem& p) { p.water_per_shot = 3.0; },
      [](SupplyProblem& p) { p.charge_per_shot = 300.0; },
      [](SupplyProblem& p) { p.charge_per_second = -1.0; },
      [](SupplyProblem& p) { p.stations[0].stop = 4; },
      [](SupplyProblem& p) { p.stations[0].per_unit_s = nan; },
      [](SupplyProblem& p) { p.water = std::numeric_limits<double>::infinity(); },
  };
  SupplyProblem good = line();
  good.water = 2.0;
  good.charge = 100.0;
  good.stations = {{3, Store::water, 5.0, 2.0}};
  ASSERT_TRUE(solve_supplied(good, {}, {}));
  for (std::size_t i = 0; i < corruptions.size(); ++i) {
    SupplyProblem bad = good;
    corruptions[i](bad);
    const auto tour = solve_supplied(bad, {}, {});
    ASSERT_FALSE(tour) << "corruption " << i;
    EXPECT_FALSE(tour.error().sentence.empty());
  }
  EXPECT_FALSE(solve_supplied(good, {.exact_goals = 99}, {}));
  EXPECT_FALSE(solve_supplied(good, {}, {.expansions = 0, .wall_time = {}, .stop = {}}));
}

}  // namespace
}  // namespace outrider
