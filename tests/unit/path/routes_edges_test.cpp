#include "outrider/path/routes/routes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

#include "routes_twin.hpp"

namespace outrider {
namespace {

using testing::big_yard;
using testing::box;
using testing::expect_consistent;
using testing::expect_sound;
using testing::inf;
using testing::ring_nodes;
using testing::routes_of;
using testing::tight_ring;
using testing::Twin;
using testing::Yard;

TEST(Routes, OnePlaceTakesNoTime) {
  Yard yard;
  yard.stops = {{1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}};
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 0}, {0, 1}, {1, 0}}) {
    EXPECT_EQ(routes->between(i, j).time_s, 0.0);
    EXPECT_EQ(routes->waypoints(i, j), std::vector<Vec2>{yard.stops[0]});
  }
  EXPECT_DOUBLE_EQ(routes->between(1, 2).time_s, duration(1.0, yard.robot.straight()));
  EXPECT_DOUBLE_EQ(routes->between(2, 1).departure_rad, pi);
  const auto still = routes->route({{1.0, 1.0}, 0.5}, {1.0, 1.0});
  ASSERT_TRUE(still);
  EXPECT_EQ(still->waypoints.size(), 1U);
  EXPECT_EQ(still->cost.time_s, 0.0);
  EXPECT_EQ(still->cost.heading_rad, 0.5);
}

TEST(Routes, NoStopsIsNoError) {
  Yard yard;
  yard.obstacles.push_back(box({0.0, 0.0}, 0.5, 0.5));
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  EXPECT_TRUE(routes->route({{-2.0, 0.0}, 0.0}, {2.0, 0.0}));
}

TEST(Routes, SlideAlongAWallInContact) {
  Yard yard;
  yard.obstacles.push_back(box({0.0, 0.0}, 1.0, 0.5));
  const double y = 0.5 + yard.robot.radius_m;
  yard.stops = {{-2.0, y}, {2.0, y}};
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  EXPECT_EQ(routes->waypoints(0, 1).size(), 2U);
}

TEST(Routes, FewerHaltsAreWorthADetour) {
  Yard yard;
  yard.obstacles.push_back(box({-1.5, 0.0}, 1.5, 0.1));
  yard.stops = {{-1.0, -0.8}, {-1.0, 0.8}};
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  EXPECT_LE(routes->waypoints(0, 1).size(), 4U);
  EXPECT_NEAR(routes->between(0, 1).time_s, Twin(yard, pi / 4).times_from(0, nullptr)[1], 1e-9);
}

TEST(Routes, AWallAcrossTheYardPartsIt) {
  Yard yard;
  yard.obstacles.push_back(box({0.0, 0.0}, 0.1, 3.0));
  yard.stops = {{-2.0, 0.0}, {2.0, 0.0}, {-2.0, 1.0}};
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  EXPECT_EQ(routes->between(0, 1).time_s, inf);
  EXPECT_EQ(routes->between(1, 2).time_s, inf);
  EXPECT_LT(routes->between(0, 2).time_s, inf);
  EXPECT_TRUE(routes->waypoints(1, 0).empty());
  const auto route = routes->route({{-2.0, 0.0}, 0.0}, {2.0, 0.0});
  ASSERT_FALSE(route);
  EXPECT_EQ(route.error().code, FaultCode::no_path);
}

TEST(Routes, ExtraNodesOpenAPassageTooNarrowForTheCorners) {
  const Yard yard = tight_ring();
  const auto without = routes_of(yard);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->between(0, 1).time_s, inf);

  std::vector<Vec2> extra = ring_nodes(60);
  extra.push_back({0.0, 0.0});  // inside the pillar: left out
  const auto with = routes_of(yard, extra);
  ASSERT_TRUE(with);
  ASSERT_LT(with->between(0, 1).time_s, inf);
  expect_sound(yard, with->waypoints(0, 1));
  expect_consistent(yard, *with, 1, 0);
  EXPECT_TRUE(with->route({yard.stops[0], 0.0}, yard.stops[1]));
}

/// 700 slats beside the ring make so many corners that they are thinned; the extra nodes stay.
TEST(Routes, ExtraNodesAreNotThinned) {
  Yard yard = tight_ring();
  for (int i = 0; i < 700; ++i) yard.obstacles.push_back(box({-2.4 + 0.006 * i, 2.3}, 0.001, 0.02));
  const auto routes = routes_of(yard, ring_nodes(60));
  ASSERT_TRUE(routes) << to_string(routes.error());
  ASSERT_LT(routes->between(0, 1).time_s, inf);
  expect_sound(yard, routes->waypoints(0, 1));
}

TEST(Routes, APointRobotDoesNotPassThroughWallsOrFences) {
  Yard yard;
  yard.robot.radius_m = 0.0;
  yard.obstacles.push_back(box({0.0, 1.0}, 0.5, 2.0));
  yard.obstacles.push_back({{{0.0, -1.0}, {0.0, -2.5}}, 0.0});
  yard.stops = {{-2.0, 1.0}, {2.0, 1.0}, {-2.0, -2.0}, {2.0, -2.0}};
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  EXPECT_GT(routes->waypoints(0, 1).size(), 2U);
  EXPECT_GT(routes->waypoints(2, 3).size(), 2U);
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {2, 3}, {0, 3}}) {
    expect_sound(yard, routes->waypoints(i, j));
  }
}

TEST(Routes, ObstaclesInAHeapAreNoTrouble) {
  Yard yard;
  for (int i = 0; i < 20; ++i) yard.obstacles.push_back(box({0.0, 0.0}, 1.0, 0.5));  // one on the other
  yard.obstacles.push_back(box({1.5, 0.0}, 0.5, 0.5));                               // touching
  yard.obstacles.push_back({{{0.0, 0.5}}, 0.3});                                     // overlapping
  yard.stops = {{0.0, -2.0}, {0.0, 2.0}};
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  ASSERT_LT(routes->between(0, 1).time_s, inf);
  expect_sound(yard, routes->waypoints(0, 1));
}

TEST(Routes, ABlockedStopIsNamed) {
  Yard yard;
  yard.obstacles.push_back(box({0.0, 0.0}, 0.5, 0.5));
  yard.stops = {{2.0, 2.0}, {-2.0, 0.0}, {0.6, 0.0}};
  const auto routes = routes_of(yard);
  ASSERT_FALSE(routes);
  EXPECT_EQ(routes.error().code, FaultCode::goal_blocked);
  EXPECT_NE(routes.error().sentence.find("stop 2"), std::string::npos) << routes.error().sentence;
  EXPECT_NE(routes.error().sentence.find("0.100"), std::string::npos) << routes.error().sentence;

  yard.stops[2] = {3.5, 0.0};
  EXPECT_EQ(routes_of(yard).error().code, FaultCode::outside_map);
  yard.stops[2] = {2.9, 0.0};  // within the yard, but not with its whole disk
  EXPECT_EQ(routes_of(yard).error().code, FaultCode::goal_blocked);
  yard.stops[2] = {std::nan(""), 0.0};
  EXPECT_EQ(routes_of(yard).error().code, FaultCode::bad_input);
  yard.stops[2] = {1e300, 0.0};
  EXPECT_EQ(routes_of(yard).error().code, FaultCode::outside_map);
}

TEST(Routes, BadEndsOfOneRouteAreRefused) {
  Yard yard;
  yard.obstacles.push_back(box({0.0, 0.0}, 0.5, 0.5));
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  const Vec2 fine{2.0, 2.0};
  EXPECT_EQ(routes->route({{0.0, 0.0}, 0.0}, fine).error().code, FaultCode::start_blocked);
  EXPECT_EQ(routes->route({fine, 0.0}, {0.0, 0.0}).error().code, FaultCode::goal_blocked);
  EXPECT_EQ(routes->route({fine, 0.0}, {9.0, 0.0}).error().code, FaultCode::outside_map);
  EXPECT_EQ(routes->route({fine, inf}, {-2.0, 0.0}).error().code, FaultCode::bad_input);
  EXPECT_EQ(routes->route({{std::nan(""), 0.0}, 0.0}, fine).error().code, FaultCode::bad_input);
}

TEST(Routes, BadNumbersAreRefused) {
  Yard yard;
  yard.stops = {{0.0, 0.0}};
  for (const double step : {0.0, -1.0, radians(91.0), std::nan(""), inf}) {
    RouteOptions options;
    options.arc_step_rad = step;
    EXPECT_EQ(routes_of(yard, {}, options).error().code, FaultCode::bad_input);
  }
  EXPECT_EQ(routes_of(yard, {{0.0, std::nan("")}}).error().code, FaultCode::bad_input);
  EXPECT_EQ(routes_of(yard, std::vector<Vec2>(20'000, Vec2{})).error().code, FaultCode::bad_input);
  for (const double radius : {-0.1, std::nan(""), inf}) {
    Yard other = yard;
    other.robot.radius_m = radius;
    EXPECT_EQ(routes_of(other).error().code, FaultCode::bad_input);
  }
  Yard still = yard;
  still.robot.speed_mps = 0.0;
  EXPECT_EQ(routes_of(still).error().code, FaultCode::bad_input);
  Yard crowd = yard;
  crowd.stops.assign(3000, Vec2{});
  EXPECT_EQ(routes_of(crowd).error().code, FaultCode::bad_input);
}

TEST(Routes, TooManyCornersAreRefused) {
  Yard yard;
  yard.bounds = {{-50.0, -50.0}, {50.0, 50.0}};
  for (int i = 0; i < 1600; ++i)
    yard.obstacles.push_back({{{2.4 * (i % 40) - 47.0, 2.4 * (i / 40) - 47.0}}, 0.2});
  const auto routes = routes_of(yard);
  ASSERT_FALSE(routes);
  EXPECT_EQ(routes.error().code, FaultCode::bad_input);
  EXPECT_NE(routes.error().sentence.find("16384"), std::string::npos);
}

TEST(Routes, TheBudgetIsKeptToTheExpansion) {
  const Yard yard = big_yard(12, 30, 20);
  Budget budget;
  std::uint64_t low = 0;  // refused
  std::uint64_t high = 1 << 20;
  while (high - low > 1) {
    budget.expansions = std::midpoint(low, high);
    const auto routes = routes_of(yard, {}, {}, budget);
    if (!routes) {
      EXPECT_EQ(routes.error().code, FaultCode::budget_exhausted);
    }
    (routes ? high : low) = budget.expansions;
  }
  EXPECT_GT(high, 40U);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  budget.expansions = low;
  EXPECT_FALSE(routes_of(yard, {}, {}, budget));
  budget.expansions = high;
  EXPECT_TRUE(routes_of(yard, {}, {}, budget));
  budget.expansions = 0;
  EXPECT_EQ(routes_of(yard, {}, {}, budget).error().code, FaultCode::budget_exhausted);
}

TEST(Routes, AreCancelledOrTimedOut) {
  const Yard yard = big_yard(12, 30, 20);
  std::stop_source source;
  source.request_stop();
  Budget budget;
  budget.stop = source.get_token();
  EXPECT_EQ(routes_of(yard, {}, {}, budget).error().code, FaultCode::cancelled);
  Budget no_time;
  no_time.wall_time = std::chrono::nanoseconds(0);
  EXPECT_EQ(routes_of(yard, {}, {}, no_time).error().code, FaultCode::budget_exhausted);
}

TEST(Routes, OptionsDescribeThemselves) {
  RouteOptions options;
  const auto described = describe(options);
  ASSERT_EQ(described.size(), 1U);
  EXPECT_EQ(described[0].name, "arc_step");
  EXPECT_EQ(value_text(described[0]), "45");
}

}  // namespace
}  // namespace outrider
