#include "outrider/sim/walks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

Routes routes_on_open_ground(const std::vector<Vec2>& places) {
  World world;
  world.bounds = {{-5.0, -5.0}, {5.0, 5.0}};
  const CollisionMap ground = CollisionMap::of(world, 1.0);
  auto routes = routes_between(ground, RobotModel{}, places, {}, {}, {});
  EXPECT_TRUE(routes.has_value());
  return std::move(*routes);
}

TEST(Walks, LeadFromPlaceToPlaceAtTheirSpeedAndRestThere) {
  const Walkers walkers{{{-3.0, 0.0}, {3.0, 0.0}, {0.0, 3.0}}, {1.0, 1.0, 0.0}, 0.5, 2.0};
  const Routes routes = routes_on_open_ground(walkers.places);
  const auto walks = draw_walks(walkers, routes, 7, 100.0);
  ASSERT_TRUE(walks.has_value());
  ASSERT_EQ(walks->size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& knots = (*walks)[i].knots;
    EXPECT_EQ(knots.front().position, walkers.places[i]);
    EXPECT_GT(knots.back().time_s, 100.0);
    for (std::size_t k = 1; k < knots.size(); ++k) {
      const double way_m = distance(knots[k - 1].position, knots[k].position);
      const double time_s = knots[k].time_s - knots[k - 1].time_s;
      EXPECT_GT(time_s, 0.0);
      EXPECT_TRUE(way_m == 0.0 || std::abs(way_m / time_s - 0.5) < 1e-9);
      EXPECT_TRUE(k == 1 || knots[k].position != walkers.places[2]) << "nobody wants to go there";
    }
  }
  const auto again = draw_walks(walkers, routes, 7, 100.0);
  ASSERT_TRUE(again.has_value());
  EXPECT_TRUE(
      std::ranges::equal((*walks)[0].knots, (*again)[0].knots, {}, &Walk::Knot::time_s, &Walk::Knot::time_s));
}

TEST(Walks, EndWhereThereIsNowhereToGo) {
  const Walkers walkers{{{0.0, 0.0}, {3.0, 0.0}}, {0.0, 0.0}, 1.0, 1.0};
  const auto walks = draw_walks(walkers, routes_on_open_ground(walkers.places), 1, 1000.0);
  ASSERT_TRUE(walks.has_value());
  EXPECT_EQ((*walks)[0].at(500.0), walkers.places[0]);
}

}  // namespace
}  // namespace outrider
