// The proof beside the tour: sweeps and the exact end, against brute force and against the A* over all sets.
#include <gtest/gtest.h>

#include <algorithm>

#include "brute_force.hpp"
#include "outrider/tour/solve.hpp"
#include "random_tour.hpp"
#include "support/costly_cases.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Without the A* over all sets of goals.
TourOptions by_sweeps(double gap, std::int64_t iterations) {
  TourOptions options;
  options.exact_goals = 0;
  options.gap = gap;
  options.iterations = iterations;
  return options;
}

Tour solved(const TourProblem& problem, const TourOptions& options) {
  auto tour = solve(problem, options, {});
  EXPECT_TRUE(tour) << tour.error().sentence;
  const Status judged = check(problem, *tour);
  EXPECT_TRUE(judged) << judged.error().sentence;
  return *tour;
}

TourProblem small_problem(std::size_t seed) {
  return seed % 2 == 0 ? random_table(1 + seed % 4, 1 + seed % 3, seed)
                       : random_yard(1 + seed % 5, 1 + seed % 4, 3, seed);
}

std::size_t cases_of(int usual) { return static_cast<std::size_t>(testing::cases(usual)); }

/// Up to ten goals; a table in two, where stops serve half of all, at the start too.
TourProblem problem_of(std::size_t seed) {
  return seed % 2 == 0 ? random_table(5 + seed % 6, 3 + seed % 4, seed)
                       : random_yard(6 + seed % 5, 10 + seed % 20, 6, seed);
}

TEST(Proof, EqualsBruteForce) {
  for (std::size_t seed = 0; seed < cases_of(600); ++seed) {
    const TourProblem problem = small_problem(seed);
    const Tour tour = solved(problem, by_sweeps(0.0, 0));
    ASSERT_TRUE(tour.proven_optimal) << "seed " << seed;
    ASSERT_NEAR(tour.cost_s, brute_force(problem), 1e-6) << "seed " << seed;
  }
}

TEST(Proof, EqualsTheSearchOverAllSets) {
  for (std::size_t seed = 0; seed < static_cast<std::size_t>(testing::costly_cases(150)); ++seed) {
    const TourProblem problem = problem_of(seed);
    const Tour best = solved(problem, {});
    ASSERT_TRUE(best.proven_optimal);
    const Tour tour = solved(problem, by_sweeps(0.0, 30));
    ASSERT_TRUE(tour.proven_optimal) << "seed " << seed;
    ASSERT_NEAR(tour.cost_s, best.cost_s, 1e-6) << "seed " << seed;
  }
}

TEST(Proof, BoundsHoldHoweverLittleWorkIsAllowed) {
  for (std::size_t seed = 0; seed < static_cast<std::size_t>(std::max(4, testing::costly_cases(16)));
       ++seed) {
    const TourProblem problem = problem_of(seed);
    const double optimum = solved(problem, {}).cost_s;
    for (const double gap : {0.0, 0.02, 0.3, 0.9, 1.0}) {
      for (const std::int64_t work : {0, 300, 30'000, 100'000'000}) {
        TourOptions options = by_sweeps(gap, 5);
        options.operations = work;
        options.expansions = work / 1000;
        const Tour tour = solved(problem, options);
        ASSERT_LE(tour.lower_bound_s, optimum + 1e-6) << "seed " << seed;
        if (work == 100'000'000) {
          EXPECT_GE(tour.lower_bound_s, (1.0 - gap) * tour.cost_s - 1e-6);
        }
      }
    }
  }
}

TEST(Proof, StatedGapForTwentyFourGoals) {
  const TourProblem problem = random_yard(24, 60, 12, 3);
  const Tour tour = solved(problem, by_sweeps(0.02, 4000));
  EXPECT_GE(tour.lower_bound_s, 0.98 * tour.cost_s - 1e-6);
  const Tour again = solved(problem, by_sweeps(0.02, 4000));
  EXPECT_EQ(tour.lower_bound_s, again.lower_bound_s);
  EXPECT_EQ(tour.visits, again.visits);
}

TEST(Proof, BoundsAHundredGoals) {
  const Tour tour = solved(random_yard(100, 60, 30, 5), by_sweeps(0.05, 2000));
  EXPECT_GE(tour.lower_bound_s, 0.75 * tour.cost_s);
  EXPECT_FALSE(tour.proven_optimal);
}

TEST(SolveFrom, NeverEndsWorseAndRefusesWhatIsNoTour) {
  const TourProblem problem = random_yard(14, 30, 6, 2);
  const Tour begun = solved(problem, by_sweeps(1.0, 0));
  const auto further = solve_from(problem, begun, by_sweeps(1.0, 300), {});
  ASSERT_TRUE(further);
  EXPECT_LE(further->cost_s, begun.cost_s);
  Tour broken = begun;
  broken.visits.pop_back();
  EXPECT_FALSE(solve_from(problem, broken, by_sweeps(1.0, 0), {}));
}

}  // namespace
}  // namespace outrider
