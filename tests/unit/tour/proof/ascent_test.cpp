// Shares and what they leave unpaid: together below every tour; for one stop the least tree of its aims.
#include "proof/ascent.hpp"

#include <gtest/gtest.h>

#include "brute_force.hpp"
#include "proof/remainder.hpp"
#include "random_tour.hpp"
#include "support/random_cases.hpp"

namespace outrider::tour {
namespace {

std::size_t cases_of(int usual) { return static_cast<std::size_t>(testing::cases(usual)); }

/// The bound of shares and remainder with the first `apart` goals apart.
double bound_of(const TourProblem& problem, std::uint32_t apart, double most_s, std::uint32_t sectors) {
  const Instance instance = *compile(problem);
  AscentRules rules{{}, most_s};
  for (std::uint32_t goal = 0; goal < apart; ++goal) rules.apart.push_back(goal);
  BudgetMeter meter({});
  const Shares shares = ascend(instance, rules, meter);
  for (const float left : shares.drive_left) EXPECT_GE(left, 0.0F);
  for (const float left : shares.serve_left) EXPECT_GE(left, 0.0F);
  return shares.total + remainder(instance, shares, rules.apart, sectored(instance, sectors), meter);
}

TEST(Ascent, IsBelowBruteForceHoweverTheGoalsAreDivided) {
  for (std::size_t seed = 0; seed < cases_of(400); ++seed) {
    const TourProblem problem = seed % 2 == 0 ? random_table(1 + seed % 4, 1 + seed % 3, seed)
                                              : random_yard(1 + seed % 5, 1 + seed % 6, 3, seed);
    const double optimum = brute_force(problem);
    const auto goals = static_cast<std::uint32_t>(problem.goals);
    for (const std::uint32_t apart : {0U, goals / 2, goals}) {
      for (const double most_s : {0.0, 0.8, 3.0, infinity}) {
        const double bound = bound_of(problem, apart, most_s, seed % 3 == 0 ? 1 : 32);
        ASSERT_LE(bound, optimum + 1e-6) << "seed " << seed << ", " << apart << " apart, " << most_s << " s";
        ASSERT_GE(bound, 0.0);
      }
    }
  }
}

/// Prim's tree over the services of stop 1 and the stop itself, from which a first service costs `fee`.
double least_tree(const Instance& instance, double fee) {
  const std::uint32_t count = instance.first[2] - instance.first[1];
  const TourNode* const nodes = instance.nodes.data() + instance.first[1];
  std::vector<double> away(count, fee);
  std::vector<bool> in(count, false);
  double length = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t next = none;
    for (std::uint32_t n = 0; n < count; ++n) {
      if (!in[n] && (next == none || away[n] < away[next])) next = n;
    }
    in[next] = true;
    length += away[next] + nodes[next].duration;
    for (std::uint32_t n = 0; n < count; ++n) {
      away[n] = std::min(
          away[n], aim_time(instance, nodes[next].yaw, nodes[next].pitch, nodes[n].yaw, nodes[n].pitch));
    }
  }
  return length;
}

TEST(Ascent, GivesTheLeastTreeOfOneStop) {
  constexpr double fee_s = 0.5;
  for (std::size_t seed = 0; seed < cases_of(40); ++seed) {
    const TourProblem problem = random_yard(2 + seed, 1, 1, seed);
    const Instance instance = *compile(problem);
    const double drive = instance.time[instance.arc(0, 1)];
    const double tree = drive - fee_s + least_tree(instance, fee_s);
    const double bound = bound_of(problem, 0, infinity, 1);
    ASSERT_LE(bound, tree + 1e-6) << "seed " << seed;
    ASSERT_GE(bound, 0.98 * tree) << "seed " << seed;
  }
}

TEST(Ascent, HoldsWhereTheBudgetEnds) {
  const TourProblem problem = random_yard(9, 20, 5, 4);
  const Instance instance = *compile(problem);
  double before = 0.0;
  for (const std::uint64_t steps : {0U, 10U, 100U, 1'000'000U}) {
    Budget budget;
    budget.expansions = steps;
    BudgetMeter meter(budget);
    const double total = ascend(instance, {}, meter).total;
    EXPECT_GE(total, before);
    before = total;
  }
  EXPECT_GT(before, 0.0);
}

}  // namespace
}  // namespace outrider::tour
