#include "yard/way_around.hpp"

#include <gtest/gtest.h>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

TEST(WayAround, IsFreeAndApartInRandomYards) {
  Rng rng(19);
  int found = 0, led = 0;
  for (int i = 0; i < cases(40); ++i) {
    const auto problem = testing::random_guard_problem(rng, 8, 1, 3.0);
    const auto firing_map = build_firing_map(problem, testing::quick());
    ASSERT_TRUE(firing_map.has_value());
    std::vector<Vec2> places;
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
      if (firing_map->reachable[c] != 0) places.push_back(firing_map->place(c));
    }
    const auto place = [&] { return places[rng.below(places.size())]; };
    const Vec2 from = place(), to = place();
    const std::vector<Vec2> standing{place(), 0.5 * (from + to)};
    const double gap_m = 0.7;
    const auto way = way_around(problem, *firing_map, from, to, standing, gap_m);
    if (!way) continue;
    ++found;
    led += way->size() > 2 ? 1 : 0;
    EXPECT_EQ(way->front(), from);
    EXPECT_EQ(way->back(), to);
    for (std::size_t k = 1; k < way->size(); ++k) {
      const Vec2 a = (*way)[k - 1], b = (*way)[k];
      for (int s = 0; s <= 200; ++s) {
        const Vec2 at = a + s / 200.0 * (b - a);
        EXPECT_GE(firing_map->ground.clearance(at, 1.0), problem.robot.radius_m - 1e-9);
        for (const Vec2 other : standing) EXPECT_GE(distance(at, other), gap_m - 1e-9);
      }
    }
  }
  EXPECT_GT(found, cases(40) / 8);
  EXPECT_GT(led, 0);
}

}  // namespace
}  // namespace outrider
