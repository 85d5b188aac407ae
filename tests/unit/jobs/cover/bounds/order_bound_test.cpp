#include "bounds/order_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct RandomOrder {
  TourProblem problem;
  std::vector<std::vector<std::size_t>> stops_of;  ///< by goal
};

/// Units with a few ways each, whose ends lie in a square; drives take as long as they are.
RandomOrder random_order(Rng& rng, std::size_t goals, bool started) {
  RandomOrder order;
  order.problem.goals = goals;
  order.problem.services.resize(1);
  std::vector<Vec2> entries{testing::random_point(rng, 5.0)}, exits = entries;
  for (std::size_t goal = 0; goal < goals; ++goal) {
    order.stops_of.emplace_back();
    for (std::uint64_t ways = 1 + rng.below(4); ways > 0; --ways) {
      order.stops_of.back().push_back(order.problem.services.size());
      order.problem.services.push_back({{static_cast<std::uint32_t>(goal), 0.0, 0.0, rng.uniform(1.0, 4.0)}});
      entries.push_back(testing::random_point(rng, 5.0));
      exits.push_back(testing::random_point(rng, 5.0));
    }
  }
  const std::size_t n = entries.size();
  order.problem.drives.assign(n * n, Drive{0.0, 0.0, 0.0});
  for (std::size_t i = started ? 0 : 1; i < n; ++i) {
    for (std::size_t j = 1; j < n; ++j) {
      if (i != j) order.problem.drives[i * n + j].time_s = distance(exits[i], entries[j]);
    }
  }
  return order;
}

/// The least time of all orders and ways from there, one after another.
double least_time(const RandomOrder& order, std::size_t at, std::vector<bool>& served) {
  double least = std::numeric_limits<double>::infinity();
  bool all = true;
  const std::size_t n = order.problem.services.size();
  for (std::size_t goal = 0; goal < served.size(); ++goal) {
    if (served[goal]) continue;
    all = false;
    served[goal] = true;
    for (const std::size_t stop : order.stops_of[goal]) {
      const double here =
          order.problem.drives[at * n + stop].time_s + order.problem.services[stop].front().duration_s;
      least = std::min(least, here + least_time(order, stop, served));
    }
    served[goal] = false;
  }
  return all ? 0.0 : least;
}

TEST(OrderBound, IsNeverAboveTheBestOfAllOrdersAndNearIt) {
  Rng rng(41);
  double ratios = 0.0;
  int cases = 0;
  for (int k = 0; k < testing::cases(60); ++k) {
    const bool started = rng.below(2) == 0;
    const RandomOrder order = random_order(rng, 1 + rng.below(6), started);
    std::vector<bool> served(order.problem.goals, false);
    const double best = least_time(order, 0, served);
    const double bound = cover::order_bound_s(order.problem, started, best);
    EXPECT_LE(bound, best * (1.0 + 1e-12)) << "case " << k;
    EXPECT_GT(bound, 0.0);
    ratios += bound / best;
    ++cases;
  }
  EXPECT_GT(ratios / cases, 0.9);
}

/// A search that is stopped still gives a bound, which is 0 at first.
TEST(OrderBound, AStopLeavesABound) {
  Rng rng(42);
  const RandomOrder order = random_order(rng, 6, true);
  std::stop_source source;
  source.request_stop();
  ASSERT_GT(cover::order_bound_s(order.problem, true, 10.0), 0.0);
  EXPECT_EQ(cover::order_bound_s(order.problem, true, 10.0, source.get_token()), 0.0);
}

TEST(OrderBound, OneUnitTakesItsBestWay) {
  TourProblem problem;
  problem.goals = 1;
  problem.services = {{}, {{0, 0.0, 0.0, 5.0}}, {{0, 0.0, 0.0, 3.0}}};
  problem.drives.assign(9, Drive{0.0, 0.0, 0.0});
  problem.drives[1].time_s = 1.0;
  problem.drives[2].time_s = 4.0;
  EXPECT_NEAR(cover::order_bound_s(problem, true, 6.0), 6.0, 1e-6);
  EXPECT_NEAR(cover::order_bound_s(problem, false, 3.0), 3.0, 1e-6);
}

}  // namespace
}  // namespace outrider
