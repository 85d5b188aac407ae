#include "outrider/path/routes/routes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "routes_twin.hpp"
#include "support/random_cases.hpp"
#include "support/random_terrain.hpp"

namespace outrider {
namespace {

using testing::big_yard;
using testing::box;
using testing::cases;
using testing::expect_consistent;
using testing::expect_sound;
using testing::inf;
using testing::random_robot;
using testing::random_yard;
using testing::routes_of;
using testing::Twin;
using testing::twin_leg_free;
using testing::twin_nodes;
using testing::Yard;

TEST(Routes, AreTheFastestOnTheGraph) {
  int joined = 0;
  int bent = 0;
  for (int seed = 0; seed < cases(60); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const RobotModel robot = seed % 2 == 0 ? RobotModel{} : random_robot(rng);
    const Yard yard = random_yard(rng, 1 + static_cast<int>(rng.below(12)), 6, robot);
    RouteOptions options;
    options.arc_step_rad = radians(std::vector<double>{45.0, 60.0, 90.0}[rng.below(3)]);
    std::vector<Vec2> extra;
    for (int i = 0; i < 20; ++i) extra.push_back(testing::random_point(rng, 3.0));
    const auto routes = routes_of(yard, extra, options);
    ASSERT_TRUE(routes) << to_string(routes.error());
    const Twin twin(yard, options.arc_step_rad, extra);
    for (std::size_t i = 0; i < yard.stops.size(); ++i) {
      const std::vector<double> expected = twin.times_from(i, nullptr);
      for (std::size_t j = 0; j < yard.stops.size(); ++j) {
        const double actual = routes->between(i, j).time_s;
        ASSERT_EQ(actual < inf, expected[j] < inf) << "seed " << seed << " stops " << i << " " << j;
        if (actual == inf) continue;
        EXPECT_NEAR(actual, expected[j], 1e-9) << "seed " << seed << " stops " << i << " " << j;
        ++joined;
        if (routes->waypoints(i, j).size() > 2) ++bent;
      }
    }
  }
  EXPECT_GT(joined, 500);
  EXPECT_GT(bent, 100);
}

TEST(Routes, AreTheFastestOnALargeGraph) {
  for (int seed = 0; seed < cases(1); ++seed) {
    const Yard yard = big_yard(static_cast<std::uint64_t>(seed), 30, 40);
    const auto routes = routes_of(yard);
    ASSERT_TRUE(routes) << to_string(routes.error());
    const Twin twin(yard, RouteOptions{}.arc_step_rad);
    for (const std::size_t i : {0U, 20U, 36U, 38U}) {
      const std::vector<double> expected = twin.times_from(i, nullptr);
      for (std::size_t j = 0; j < yard.stops.size(); ++j) {
        const double actual = routes->between(i, j).time_s;
        ASSERT_EQ(actual < inf, expected[j] < inf) << "seed " << seed << " stops " << i << " " << j;
        if (actual == inf) continue;
        EXPECT_NEAR(actual, expected[j], 1e-9) << "seed " << seed << " stops " << i << " " << j;
      }
    }
  }
}

/// A row of 700 thin slats makes 5,600 corners. Each route of the thinned graph is sound, and no longer than
/// one past the hull of all slats.
TEST(Routes, ManyCloseCornersAreThinned) {
  Yard slats;
  for (int i = 0; i < 700; ++i)
    slats.obstacles.push_back(box({-1.4 + 0.004 * i, 0.0}, 0.001, 1.0 + 0.0001 * (i % 7)));
  slats.robot.radius_m = 0.2;
  slats.stops = {{0.0, -2.0}, {0.0, 2.0}, {-2.0, 0.0}, {2.0, 0.3}};
  const auto routes = routes_of(slats);
  ASSERT_TRUE(routes) << to_string(routes.error());
  Yard hull = slats;
  hull.obstacles = {box({0.0, 0.0}, 1.42, 1.01)};
  hull.robot.radius_m = 0.25;  // a quarter more
  const auto around = routes_of(hull);
  ASSERT_TRUE(around) << to_string(around.error());
  for (std::size_t i = 0; i < slats.stops.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      expect_consistent(slats, *routes, i, j);
      EXPECT_LE(routes->between(i, j).time_s, around->between(i, j).time_s);
    }
  }
}

/// West of the block is the sooner way to the end of the wall, east of it the way that turns less there.
TEST(Routes, TheHeadingOnArrivalMayDecide) {
  Yard yard;
  yard.robot.radius_m = 0.2;
  yard.robot.turn_rate_radps = 0.1;
  yard.obstacles.push_back(box({0.8, -1.0}, 1.2, 0.2));
  yard.obstacles.push_back(box({-1.65, 0.0}, 1.35, 0.1));
  yard.stops = {{-0.2, -2.0}, {-2.5, 0.6}, {0.0, 0.5}};
  RouteOptions options;
  options.arc_step_rad = pi / 2;
  const auto routes = routes_of(yard, {}, options);
  ASSERT_TRUE(routes);
  const auto farthest_east = [&](std::size_t to) {
    double x = -inf;
    for (const Vec2 p : routes->waypoints(0, to)) x = std::max(x, p.x);
    return x;
  };
  EXPECT_LT(farthest_east(2), 1.0);
  EXPECT_GT(farthest_east(1), 1.0);
  const std::vector<double> expected = Twin(yard, options.arc_step_rad).times_from(0, nullptr);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(routes->between(0, j).time_s, expected[j], 1e-9);
}

TEST(Routes, OneRouteCountsTheFirstTurn) {
  int joined = 0;
  for (int seed = 100; seed < 100 + cases(25); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const Yard yard = random_yard(rng, 1 + static_cast<int>(rng.below(8)), 4);
    const auto routes = routes_of(yard);
    ASSERT_TRUE(routes) << to_string(routes.error());
    const Twin twin(yard, RouteOptions{}.arc_step_rad);
    for (std::size_t i = 0; i < yard.stops.size(); ++i) {
      const Pose2 start{yard.stops[i], rng.uniform(-7.0, 7.0)};
      const std::vector<double> expected = twin.times_from(i, &start.heading_rad);
      for (std::size_t j = 0; j < yard.stops.size(); ++j) {
        const auto route = routes->route(start, yard.stops[j]);
        ASSERT_EQ(route.has_value(), expected[j] < inf) << "seed " << seed;
        if (!route) {
          EXPECT_EQ(route.error().code, FaultCode::no_path);
          continue;
        }
        EXPECT_NEAR(route->cost.time_s, expected[j], 1e-9) << "seed " << seed;
        EXPECT_EQ(route->waypoints.front(), start.position);
        EXPECT_EQ(route->waypoints.back(), yard.stops[j]);
        expect_sound(yard, route->waypoints);
        ++joined;
      }
    }
  }
  EXPECT_GT(joined, 150);
}

TEST(Routes, EveryLegIsFreeAndEveryNumberAgrees) {
  const Yard yard = big_yard(7, 60, 25);
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes) << to_string(routes.error());
  for (std::size_t i = 0; i < yard.stops.size(); ++i) {
    for (std::size_t j = 0; j < yard.stops.size(); ++j) {
      expect_consistent(yard, *routes, i, j);
      if (i < j) expect_sound(yard, routes->waypoints(i, j));
    }
  }
}

TEST(Routes, BackIsThereReversed) {
  const Yard yard = big_yard(8, 60, 30);
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  for (std::size_t i = 0; i < yard.stops.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(routes->between(i, j).time_s, routes->between(j, i).time_s);
      std::vector<Vec2> back = routes->waypoints(i, j);
      std::reverse(back.begin(), back.end());
      EXPECT_EQ(back, routes->waypoints(j, i));
    }
  }
}

void expect_times_of_the_table(const Routes& routes, const Yard& yard) {
  for (std::size_t i = 0; i < yard.stops.size(); ++i) {
    for (std::size_t j = 0; j < yard.stops.size(); ++j) {
      const Drive drive = routes.between(i, j);
      if (i == j || drive.time_s == inf) continue;
      const auto route = routes.route({yard.stops[i], drive.departure_rad}, yard.stops[j]);
      ASSERT_TRUE(route);
      EXPECT_NEAR(route->cost.time_s, drive.time_s, 1e-6);
      const auto turned = routes.route({yard.stops[i], drive.departure_rad + 2.0}, yard.stops[j]);
      ASSERT_TRUE(turned);
      EXPECT_GE(turned->cost.time_s, drive.time_s - 1e-6);
      EXPECT_LE(turned->cost.time_s, drive.time_s + duration(2.0, yard.robot.turning()) + 1e-6);
    }
  }
}

TEST(Routes, ARouteFromTheBestHeadingTakesTheTimeOfTheTable) {
  const Yard yard = big_yard(9, 60, 12);
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  expect_times_of_the_table(*routes, yard);
}

TEST(Routes, ARouteOnAHillTakesTheTimeOfTheTable) {
  const Yard yard = big_yard(10, 40, 10);
  const auto hill = std::make_shared<const HeightField>(testing::hill(11.0, 0.5, 6.0, 8.0));
  const CollisionMap ground(yard.bounds, yard.obstacles, hill);
  const auto routes = routes_between(ground, yard.robot, yard.stops, {}, {}, {});
  ASSERT_TRUE(routes) << to_string(routes.error());
  expect_times_of_the_table(*routes, yard);
}

TEST(Routes, AMirroredOrTurnedYardTakesTheSameTimes) {
  const Yard yard = big_yard(10, 40, 15);
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  const auto changed = [&](auto change, bool flips) {
    Yard other = yard;
    for (RoundedPolygon& obstacle : other.obstacles) {
      for (Vec2& p : obstacle.core) p = change(p);
      if (flips) std::reverse(obstacle.core.begin(), obstacle.core.end());
    }
    for (Vec2& p : other.stops) p = change(p);
    return other;
  };
  for (const Yard& other : {changed([](Vec2 p) { return perpendicular(p); }, false),
                            changed([](Vec2 p) { return Vec2{-p.x, p.y}; }, true)}) {
    const auto same = routes_of(other);
    ASSERT_TRUE(same);
    for (std::size_t i = 0; i < yard.stops.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_NEAR(same->between(i, j).time_s, routes->between(i, j).time_s, 1e-9);
      }
    }
  }
}

TEST(Routes, AreTheSameWithAnyNumberOfThreads) {
  const Yard yard = big_yard(11, 60, 100);
  const auto together = routes_of(yard);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = routes_of(yard);
  ASSERT_TRUE(together);
  ASSERT_TRUE(alone);
  for (std::size_t i = 0; i < yard.stops.size(); ++i) {
    for (std::size_t j = 0; j < yard.stops.size(); ++j) {
      EXPECT_EQ(together->between(i, j).time_s, alone->between(i, j).time_s);
      EXPECT_EQ(together->between(i, j).departure_rad, alone->between(i, j).departure_rad);
      EXPECT_EQ(together->between(i, j).arrival_rad, alone->between(i, j).arrival_rad);
      EXPECT_EQ(together->waypoints(i, j), alone->waypoints(i, j));
    }
  }
}

/// The length bound of the header: the robot whose rounded corners are k times as wide, on a graph so
/// fine that it is nearly exact, by Floyd and Warshall.
TEST(Routes, AreFasterThanTheShortestPathOfASlightlyWiderRobot) {
  const double step = pi / 4;
  const double k = 1.0 / std::cos(step / 2);
  int compared = 0;
  for (int seed = 200; seed < 200 + cases(10); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const Yard yard = random_yard(rng, 5, 4);
    Yard wide = yard;
    for (RoundedPolygon& obstacle : wide.obstacles) {
      obstacle.radius_m = k * (obstacle.radius_m + yard.robot.radius_m) - yard.robot.radius_m;
    }
    std::vector<Vec2> points = twin_nodes(wide, radians(20.0));
    const std::size_t nodes = points.size();
    points.insert(points.end(), yard.stops.begin(), yard.stops.end());
    const std::size_t n = points.size();
    std::vector<double> length(n * n, inf);
    for (std::size_t a = 0; a < n * n; ++a) {
      const Segment s{points[a / n], points[a % n]};
      if (twin_leg_free(wide, s)) length[a] = distance(s.a, s.b);
    }
    for (std::size_t via = 0; via < nodes; ++via) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          length[i * n + j] = std::min(length[i * n + j], length[i * n + via] + length[via * n + j]);
        }
      }
    }
    // Without halts and turns, time is length: the same graph must then hold a path as short.
    Yard gliding = yard;
    gliding.robot.speed_mps = 1.0;
    gliding.robot.acceleration_mps2 = inf;
    gliding.robot.turn_rate_radps = 1e9;
    gliding.robot.turn_acceleration_radps2 = inf;
    const auto routes = routes_of(gliding);
    ASSERT_TRUE(routes);
    for (std::size_t i = 0; i < yard.stops.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double bound = length[(nodes + i) * n + nodes + j];
        if (bound == inf) continue;
        EXPECT_LE(routes->between(i, j).time_s, bound + 1e-6) << "seed " << seed;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 15);
}

}  // namespace
}  // namespace outrider
