// Durative actions against the judges of tours, and plans that something was done to.
#include "research/guard/temporal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "outrider/tour/solve.hpp"
#include "support/random_cases.hpp"
#include "unit/tour/supply/random_supply.hpp"

namespace outrider {
namespace {

constexpr double tolerance_s = 1e-3;

/// The tour problem alone: supplies without end, no stations.
SupplyProblem endless(TourProblem table) {
  SupplyProblem problem;
  problem.lengths_m.assign(table.drives.size(), 1.0);
  problem.table = std::move(table);
  return problem;
}

/// Each goal once, from a random stop of those that serve it, in a random order.
std::vector<Visit> random_visits(const TourProblem& table, Rng& rng) {
  std::vector<std::uint32_t> left(table.goals);
  for (std::uint32_t g = 0; g < table.goals; ++g) left[g] = g;
  std::vector<Visit> visits;
  std::size_t at = 0;
  while (!left.empty()) {
    const auto stop = static_cast<std::size_t>(rng.below(table.services.size()));
    const auto way = table.drives[at * table.services.size() + stop].time_s;
    const auto goal = left.begin() + static_cast<std::ptrdiff_t>(rng.below(left.size()));
    if (stop != at && std::isinf(way)) continue;
    if (std::ranges::count(table.services[stop], *goal, &Service::goal) == 0) continue;
    if (visits.empty() || stop != at) visits.push_back({stop, {}});
    visits.back().goals.push_back(*goal);
    left.erase(goal);
    at = stop;
  }
  return visits;
}

std::vector<SupplyStep> steps_of(const std::vector<Visit>& visits) {
  std::vector<SupplyStep> steps;
  for (const Visit& visit : visits) steps.push_back({visit.stop, visit.goals, {}});
  return steps;
}

struct JudgedCase {
  TemporalProblem problem;
  std::vector<TemporalAction> actions;
};

JudgedCase random_case(std::uint64_t seed) {
  Rng rng = Rng(seed).child("visits");
  const auto goals = static_cast<std::size_t>(1 + rng.below(6));
  const auto table = seed % 2 == 0 ? random_yard(goals, 5, 3, seed) : random_table(goals, 4, seed);
  auto problem = temporal_problem(endless(table));
  EXPECT_TRUE(problem);
  auto actions = temporal_actions(*problem, steps_of(random_visits(table, rng)));
  EXPECT_TRUE(actions);
  return {std::move(*problem), std::move(*actions)};
}

TEST(Temporal, AnyTourIsAValidPlanOfTheSameTime) {
  for (int seed = 0; seed < testing::cases(300); ++seed) {
    Rng rng = Rng(static_cast<std::uint64_t>(seed)).child("any");
    const auto goals = static_cast<std::size_t>(1 + rng.below(8));
    const auto s = static_cast<std::uint64_t>(seed);
    const auto table = seed % 2 == 0 ? random_yard(goals, 6, 4, s) : random_table(goals, 5, s);
    const auto problem = temporal_problem(endless(table));
    ASSERT_TRUE(problem) << problem.error().sentence;
    const auto visits = random_visits(table, rng);
    const auto actions = temporal_actions(*problem, steps_of(visits));
    ASSERT_TRUE(actions) << actions.error().sentence;
    const TemporalVerdict verdict = judge(*problem, *actions, 1e-9);
    EXPECT_TRUE(verdict.valid()) << seed << ": " << verdict.reason;
    const double time = cost(table, visits);
    EXPECT_NEAR(verdict.makespan_s, time, 1e-6 * time) << seed;
    for (std::size_t i = 1; i < actions->size(); ++i) {
      const TemporalAction& before = (*actions)[i - 1];
      EXPECT_GT((*actions)[i].start_s, before.start_s + before.duration_s) << "a gap follows each action";
    }
  }
}

TEST(Temporal, OptimalToursOnFiniteSuppliesAreValidPlans) {
  int filled = 0;
  for (int seed = 0; seed < testing::cases(60); ++seed) {
    const auto supplies = random_supply(3, 4, static_cast<std::uint64_t>(seed));
    const auto tour = solve_supplied(supplies, {}, {});
    ASSERT_TRUE(tour);
    if (!tour->dropped.empty()) continue;
    const auto problem = temporal_problem(supplies);
    ASSERT_TRUE(problem);
    const auto actions = temporal_actions(*problem, tour->steps);
    ASSERT_TRUE(actions);
    const TemporalVerdict verdict = judge(*problem, *actions, 1e-6);
    EXPECT_TRUE(verdict.valid()) << seed << ": " << verdict.reason;
    EXPECT_NEAR(verdict.makespan_s, tour->cost_s, 1e-6 * tour->cost_s) << seed;
    filled += static_cast<int>(std::ranges::count(*actions, TemporalVerb::fill, &TemporalAction::verb));
  }
  EXPECT_GT(filled, 10);
}

/// Steps that the judge of supplies refuses are refused as actions as well, and the other way round.
TEST(Temporal, SuppliesAreRefusedWhereTheirJudgeRefusesThem) {
  int refused = 0;
  for (int seed = 0; seed < testing::cases(200); ++seed) {
    Rng rng = Rng(static_cast<std::uint64_t>(seed)).child("order");
    auto supplies = random_supply(3, 3, static_cast<std::uint64_t>(seed));
    const auto visits = random_visits(supplies.table, rng);
    auto plenty = supplies;  // the same actions, where nothing runs out
    if (std::isfinite(plenty.water)) plenty.water = 1e6;
    if (std::isfinite(plenty.charge)) plenty.charge = 1e9;
    const auto generous = temporal_problem(plenty);
    const auto strict = temporal_problem(supplies);
    ASSERT_TRUE(generous && strict);
    const auto actions = temporal_actions(*generous, steps_of(visits));
    ASSERT_TRUE(actions);
    const bool possible = levels(supplies, steps_of(visits)).has_value();
    const TemporalVerdict verdict = judge(*strict, *actions, tolerance_s);
    EXPECT_EQ(verdict.valid(), possible) << seed << ": " << verdict.reason;
    if (!possible) {
      ++refused;
      const bool is_supply = verdict.reason.find("charge") != std::string::npos ||
                             verdict.reason.find("tank") != std::string::npos;
      EXPECT_TRUE(is_supply) << verdict.reason;
    }
  }
  EXPECT_GT(refused, 20);
}

using Change = std::function<bool(std::vector<TemporalAction>&, std::size_t)>;

/// Applies the change to each action of many plans in turn; all must then be refused with one of the words.
void expect_refused(const Change& change, const std::vector<std::string>& words) {
  int tried = 0;
  for (int seed = 0; seed < testing::cases(40); ++seed) {
    const JudgedCase fine = random_case(static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < fine.actions.size(); ++i) {
      auto actions = fine.actions;
      if (!change(actions, i)) continue;
      ++tried;
      const TemporalVerdict verdict = judge(fine.problem, actions, tolerance_s);
      EXPECT_FALSE(verdict.valid()) << seed << ", action " << i;
      EXPECT_TRUE(std::ranges::any_of(words, [&](const std::string& word) {
        return verdict.reason.find(word) != std::string::npos;
      })) << verdict.reason;
    }
  }
  EXPECT_GT(tried, 30);
}

TEST(Temporal, RefusesPlansWithoutAnAction) {
  expect_refused(
      [](auto& actions, std::size_t i) {
        actions.erase(actions.begin() + static_cast<std::ptrdiff_t>(i));
        return true;
      },
      {"another pose", "never hit", "takes at least"});
}

TEST(Temporal, RefusesPlansWithAnActionTwice) {
  expect_refused(
      [](auto& actions, std::size_t i) {
        actions.push_back(actions[i]);
        return actions[i].duration_s > 0.01;
      },
      {"the action before lasts until"});
  expect_refused(
      [](auto& actions, std::size_t i) {
        if (actions[i].verb != TemporalVerb::shoot) return false;
        TemporalAction again = actions[i];
        again.start_s = actions.back().start_s + actions.back().duration_s;
        actions.push_back(again);
        return true;
      },
      {"was hit before", "another pose"});
}

TEST(Temporal, RefusesPlansOutOfOrder) {
  expect_refused(
      [](auto& actions, std::size_t i) {
        if (i + 1 == actions.size() || actions[i].verb != TemporalVerb::drive) return false;
        actions[i + 1].start_s = actions[i].start_s;
        actions[i].start_s += actions[i + 1].duration_s;
        return actions[i + 1].duration_s > 0.0;
      },
      {"another pose"});
}

TEST(Temporal, RefusesWrongDurations) {
  expect_refused(
      [](auto& actions, std::size_t i) {
        actions[i].duration_s -= 0.01;
        return actions[i].duration_s >= 0.0;
      },
      {"it lasts"});
  expect_refused(
      [](auto& actions, std::size_t i) {
        actions[i].duration_s += 0.01;
        return actions[i].verb == TemporalVerb::drive;
      },
      {"it lasts"});
}

TEST(Temporal, RefusesOverlapAndOtherObjects) {
  expect_refused(
      [](auto& actions, std::size_t i) {
        if (i == 0 || actions[i - 1].duration_s < 0.01) return false;
        actions[i].start_s -= 0.5 * actions[i - 1].duration_s;
        return true;
      },
      {"the action before lasts until"});
  expect_refused(
      [](auto& actions, std::size_t i) {
        if (actions[i].verb == TemporalVerb::drive) actions[i].object = actions[i].pose;
        return actions[i].verb == TemporalVerb::drive;
      },
      {"no drive leads"});
}

TEST(Temporal, AFillNeedsItsStationAndAGunAtRest) {
  int tried = 0;
  for (int seed = 0; seed < testing::cases(60); ++seed) {
    const auto supplies = random_supply(3, 4, static_cast<std::uint64_t>(seed));
    const auto tour = solve_supplied(supplies, {}, {});
    const auto problem = temporal_problem(supplies);
    ASSERT_TRUE(tour && problem);
    if (!tour->dropped.empty()) continue;
    auto actions = *temporal_actions(*problem, tour->steps);
    const auto rest = std::ranges::find(actions, TemporalVerb::rest, &TemporalAction::verb);
    if (rest == actions.end()) continue;
    ++tried;
    actions.erase(rest);
    EXPECT_EQ(judge(*problem, actions, tolerance_s).reason, "the gun is not at rest");
  }
  EXPECT_GT(tried, 5);
}

TEST(Temporal, WaitingIsAllowedAndCounted) {
  JudgedCase fine = random_case(4);
  const double before = judge(fine.problem, fine.actions, tolerance_s).makespan_s;
  for (TemporalAction& action : fine.actions) action.start_s += 2.0;
  const TemporalVerdict later = judge(fine.problem, fine.actions, tolerance_s);
  EXPECT_TRUE(later.valid());
  EXPECT_NEAR(later.makespan_s, before + 2.0, 1e-9);
}

TEST(Temporal, TooManyDrivesAreRefused) {
  const auto refused = temporal_problem(endless(random_yard(6, 12, 4, 1)), 100);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("more than 100 drives"), std::string::npos);
}

}  // namespace
}  // namespace outrider
