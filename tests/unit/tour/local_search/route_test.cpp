#include "local_search/route.hpp"

#include <gtest/gtest.h>

#include "random_tour.hpp"

namespace outrider::tour {
namespace {

std::uint32_t draw(Rng& rng, std::size_t count) { return static_cast<std::uint32_t>(rng.below(count)); }

/// Every goal from a random stop, in random order.
Route random_route(const Instance& instance, Rng& rng) {
  Route route;
  for (std::uint32_t goal = 0; goal < instance.goals; ++goal) {
    const auto& choices = instance.nodes_of[goal];
    route.nodes.insert(route.nodes.begin() + draw(rng, route.nodes.size() + 1),
                       choices[draw(rng, choices.size())]);
  }
  refresh(instance, route);
  return route;
}

std::vector<Visit> visits_of(const Instance& instance, const Route& route) {
  std::vector<Visit> visits;
  for (const std::uint32_t n : route.nodes) {
    const std::size_t stop = instance.stop_name[instance.nodes[n].stop];
    if (visits.empty() || visits.back().stop != stop) visits.push_back({stop, {}});
    visits.back().goals.push_back(instance.nodes[n].goal);
  }
  return visits;
}

TEST(Route, CostsWhatTheModelSays) {
  Rng rng(1);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const TourProblem problem = seed % 2 == 0 ? random_table(9, 5, seed) : random_yard(9, 6, 4, seed);
    const Instance instance = *compile(problem);
    const Route route = random_route(instance, rng);
    const double judged = cost(problem, visits_of(instance, route));
    ASSERT_EQ(std::isfinite(route.cost), std::isfinite(judged));
    if (!std::isfinite(judged)) continue;
    EXPECT_NEAR(route.cost, judged, 1e-9);
  }
}

TEST(Route, SpliceCostIsTheDifference) {
  Rng rng(2);
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const TourProblem problem = seed % 2 == 0 ? random_table(9, 4, seed) : random_yard(9, 5, 4, seed);
    const Instance instance = *compile(problem);
    const Route before = random_route(instance, rng);
    Route after = before;
    const std::uint32_t begin = draw(rng, 10);
    const std::uint32_t end = begin + draw(rng, 10 - begin);
    std::vector<std::uint32_t> replacement(rng.below(4));
    for (std::uint32_t& node : replacement) node = draw(rng, instance.nodes.size());
    const double change = splice_cost(instance, before, begin, end, replacement);
    splice(instance, after, begin, end, replacement);
    if (!std::isfinite(before.cost) || !std::isfinite(after.cost)) continue;
    ++compared;
    ASSERT_NEAR(change, after.cost - before.cost, 1e-9) << "seed " << seed;
  }
  EXPECT_GT(compared, 2500);
}

TEST(Route, BestInsertionIsTheBestOfAllThatJoinOrBeginAVisit) {
  Rng rng(3);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Instance instance = *compile(random_yard(7, 8, 4, seed));
    Route route = random_route(instance, rng);
    const std::uint32_t goal = instance.nodes[route.nodes.back()].goal;
    splice(instance, route, 6, 7, {});
    const std::vector<std::uint32_t> alone(instance.stops, 0);
    const Insertion best = best_insertion(instance, route, goal, 0.0, alone);
    Route with = route;
    splice(instance, with, best.position, best.position, {&best.node, 1});
    EXPECT_NEAR(with.cost - route.cost, best.cost, 1e-9);
    for (const std::uint32_t node : instance.nodes_of[goal]) {
      EXPECT_LE(best.cost, splice_cost(instance, route, 6, 6, {&node, 1}) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace outrider::tour
