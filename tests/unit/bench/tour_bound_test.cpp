#include "tour_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

StopDistances symmetric(std::size_t count, Rng& rng, bool in_plane) {
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back({rng.uniform(), rng.uniform()});
  StopDistances distances(count, std::vector<double>(count, 0.0));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      distances[i][j] = distances[j][i] = in_plane ? distance(places[i], places[j]) : rng.uniform();
    }
  }
  return distances;
}

/// The shortest round by trying every order.
double shortest_round(const StopDistances& distances, std::vector<std::size_t> stops) {
  std::sort(stops.begin() + 1, stops.end());
  double shortest = 1e9;
  do {
    double length = distances[stops.back()][stops.front()];
    for (std::size_t i = 1; i < stops.size(); ++i) length += distances[stops[i - 1]][stops[i]];
    shortest = std::min(shortest, length);
  } while (std::next_permutation(stops.begin() + 1, stops.end()));
  return shortest;
}

TEST(TourBound, IsNeverAboveTheShortestRoundAndNearIt) {
  Rng rng(11);
  double sum = 0.0;
  const int cases = testing::cases(100);
  for (int n = 0; n < cases; ++n) {
    const std::size_t count = 2 + rng.below(6);
    const StopDistances distances = symmetric(count, rng, n % 2 == 0);
    std::vector<std::size_t> stops(count);
    std::iota(stops.begin(), stops.end(), std::size_t{0});
    const double bound = tour_bound(distances, stops, 200), shortest = shortest_round(distances, stops);
    ASSERT_LE(bound, shortest + 1e-9) << n;
    sum += bound / shortest;
  }
  EXPECT_GT(sum / cases, 0.97);
}

TEST(TourBound, LeavesOutWhatLowersIt) {
  Rng rng(12);
  for (int n = 0; n < testing::cases(50); ++n) {
    const StopDistances distances = symmetric(7, rng, false);
    std::vector<std::size_t> stops(7);
    std::iota(stops.begin(), stops.end(), std::size_t{0});
    const double all = tour_bound(distances, stops, 40);
    const double best = best_tour_bound(distances, stops);
    ASSERT_GE(best, all);
    ASSERT_EQ(stops.front(), 0U);
    ASSERT_LE(best, shortest_round(distances, stops) + 1e-9);
  }
}

}  // namespace
}  // namespace outrider
