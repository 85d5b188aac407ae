#include "outrider/path/routes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

constexpr double inf = std::numeric_limits<double>::infinity();

struct Yard {
  Box2 bounds{{-3.0, -3.0}, {3.0, 3.0}};
  std::vector<RoundedPolygon> obstacles;
  std::vector<Vec2> stops;
  RobotModel robot;

  [[nodiscard]] Ground ground() const { return {bounds, obstacles}; }
};

RoundedPolygon box(Vec2 centre, double half_x, double half_y, double yaw_rad = 0.0) {
  const Vec2 u = half_x * direction(yaw_rad);
  const Vec2 v = half_y * perpendicular(direction(yaw_rad));
  return {{centre - u - v, centre + u - v, centre + u + v, centre - u + v}, 0.0};
}

// ---- The slow twin: every obstacle for every question, every pair for every leg -----------------

double twin_clearance(const Yard& yard, Vec2 p) {
  double nearest = std::min(
      {p.x - yard.bounds.low.x, yard.bounds.high.x - p.x, p.y - yard.bounds.low.y, yard.bounds.high.y - p.y});
  for (const RoundedPolygon& obstacle : yard.obstacles)
    nearest = std::min(nearest, signed_distance(p, obstacle));
  return nearest;
}

bool twin_leg_free(const Yard& yard, Segment s) {
  const double least = yard.robot.radius_m - 1e-9;
  if (twin_clearance(yard, s.a) < least || twin_clearance(yard, s.b) < least) return false;
  return std::none_of(yard.obstacles.begin(), yard.obstacles.end(),
                      [&](const RoundedPolygon& obstacle) { return signed_distance(s, obstacle) < least; });
}

std::vector<Vec2> twin_nodes(const Yard& yard, double step_rad) {
  std::vector<Vec2> nodes;
  for (const RoundedPolygon& obstacle : yard.obstacles) {
    for (const double step : {step_rad, std::min(2.0 * step_rad, pi / 2)}) {
      for (const Vec2 c : circumscribed({obstacle.core, obstacle.radius_m + yard.robot.radius_m}, step)) {
        if (twin_clearance(yard, c) >= yard.robot.radius_m - 1e-9) nodes.push_back(c);
      }
    }
  }
  return nodes;
}

/// All pairs of nodes and stops that see each other, without pruning, and Bellman-Ford over (point,
/// point it was reached from) until nothing improves.
struct Twin {
  RobotModel robot;
  std::size_t nodes = 0;  // the stops follow
  std::vector<Vec2> points;
  std::vector<std::vector<std::size_t>> seen;

  Twin(const Yard& yard, double step_rad, const std::vector<Vec2>& extra = {})
      : robot(yard.robot), points(twin_nodes(yard, step_rad)) {
    points.insert(points.end(), extra.begin(), extra.end());
    nodes = points.size();
    points.insert(points.end(), yard.stops.begin(), yard.stops.end());
    seen.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (distance(points[i], points[j]) > 1e-9 && twin_leg_free(yard, {points[i], points[j]})) {
          seen[i].push_back(j);
        }
      }
    }
  }

  /// Least time from a stop to every stop; its first turn counts when a heading is given.
  [[nodiscard]] std::vector<double> times_from(std::size_t stop, const double* heading_rad) const {
    const std::size_t n = points.size();
    const std::size_t start = nodes + stop;
    const auto turn = [&](double a, double b) {
      return duration(std::abs(wrap_angle(b - a)), robot.turning());
    };
    std::vector<double> leg(n * n);
    std::vector<double> heading(n * n);
    for (std::size_t i = 0; i < n; ++i) {
      for (const std::size_t j : seen[i]) {
        leg[i * n + j] = duration(distance(points[i], points[j]), robot.straight());
        heading[i * n + j] = heading_of(points[j] - points[i]);
      }
    }
    std::vector<double> time(n * n, inf);  // [at * n + reached from]
    for (const std::size_t j : seen[start]) {
      const double first = heading_rad ? turn(*heading_rad, heading[start * n + j]) : 0.0;
      time[j * n + start] = first + leg[start * n + j];
    }
    for (bool improved = true; improved;) {
      improved = false;
      for (std::size_t at = 0; at < nodes; ++at) {
        for (std::size_t before = 0; before < n; ++before) {
          if (time[at * n + before] == inf) continue;
          for (const std::size_t next : seen[at]) {
            const double t = time[at * n + before] + turn(heading[before * n + at], heading[at * n + next]) +
                             leg[at * n + next];
            if (t >= time[next * n + at] - 1e-12) continue;
            time[next * n + at] = t;
            improved = true;
          }
        }
      }
    }
    std::vector<double> result(n - nodes, inf);
    for (std::size_t k = 0; k < result.size(); ++k) {
      const double* row = &time[(nodes + k) * n];
      result[k] = distance(points[nodes + k], points[start]) <= 1e-9 ? 0.0 : *std::min_element(row, row + n);
    }
    return result;
  }
};

// ---- Yards to try --------------------------------------------------------------------------------

Yard random_yard(Rng& rng, int obstacles, int stops, const RobotModel& robot = {}) {
  Yard yard;
  yard.robot = robot;
  for (int i = 0; i < obstacles; ++i) {
    const Vec2 centre = testing::random_point(rng, 3.0);
    if (rng.below(3) == 0) {
      yard.obstacles.push_back({{centre}, rng.uniform(0.05, 0.5)});
    } else {
      yard.obstacles.push_back(box(centre, rng.uniform(0.05, 1.2), rng.uniform(0.05, 0.3),
                                   rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, pi)));
    }
  }
  for (int tries = 0; static_cast<int>(yard.stops.size()) < stops && tries < 1000; ++tries) {
    const Vec2 p = testing::random_point(rng, 3.0);
    if (twin_clearance(yard, p) >= yard.robot.radius_m) yard.stops.push_back(p);
  }
  return yard;
}

/// Some robots hardly stop for a turn, others do little else; some jump to full speed.
RobotModel random_robot(Rng& rng) {
  RobotModel robot;
  robot.radius_m = rng.uniform(0.05, 0.3);
  robot.speed_mps = rng.uniform(0.3, 3.0);
  robot.acceleration_mps2 = rng.below(3) == 0 ? inf : rng.uniform(0.5, 5.0);
  robot.turn_rate_radps = rng.uniform(0.1, 2.0);
  robot.turn_acceleration_radps2 = rng.below(3) == 0 ? inf : rng.uniform(0.2, 10.0);
  return robot;
}

Yard big_yard(std::uint64_t seed, int obstacles, int stops) {
  Rng rng(seed);
  Yard yard;
  yard.bounds = {{-10.0, -10.0}, {10.0, 10.0}};
  for (int i = 0; i < obstacles; ++i) {
    const Vec2 centre = testing::random_point(rng, 10.0);
    if (i % 4 == 0) {
      yard.obstacles.push_back({{centre}, rng.uniform(0.05, 0.4)});
    } else {
      yard.obstacles.push_back(box(centre, rng.uniform(0.05, i % 7 == 0 ? 2.5 : 0.6), rng.uniform(0.05, 0.6),
                                   rng.uniform(0.0, 2.0 * pi)));
    }
  }
  while (static_cast<int>(yard.stops.size()) < stops) {
    const Vec2 p = testing::random_point(rng, 10.0);
    if (twin_clearance(yard, p) >= yard.robot.radius_m) yard.stops.push_back(p);
  }
  return yard;
}

/// A pillar in a round room that leaves the robot a ring 1 cm wider than itself: narrower than the
/// corners around the pillar.
Yard tight_ring() {
  Yard yard;
  const double inner = 1.0;
  const double outer = inner + 2.0 * yard.robot.radius_m + 0.01;
  yard.obstacles.push_back({{{0.0, 0.0}}, inner});
  for (int i = 0; i < 36; ++i) {
    const double at = radians(10.0 * i);
    yard.obstacles.push_back(box((outer + 0.2) * direction(at), 0.2, 0.3, at));
  }
  const double middle = inner + yard.robot.radius_m + 0.005;
  yard.stops = {{middle, 0.0}, {-middle, 0.0}};
  return yard;
}

std::vector<Vec2> ring_nodes(int count) {
  std::vector<Vec2> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(1.265 * direction(2.0 * pi * i / count));
  return nodes;
}

Outcome<Routes> routes_of(const Yard& yard, const std::vector<Vec2>& extra = {},
                          const RouteOptions& options = {}, const Budget& budget = {}) {
  return routes_between(yard.ground(), yard.robot, yard.stops, extra, options, budget);
}

void expect_sound(const Yard& yard, const std::vector<Vec2>& waypoints) {
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Vec2 leg = waypoints[i] - waypoints[i - 1];
    const int samples = static_cast<int>(norm(leg) / 0.02) + 2;
    for (int k = 0; k <= samples; ++k) {
      const Vec2 p = waypoints[i - 1] + static_cast<double>(k) / samples * leg;
      ASSERT_GE(twin_clearance(yard, p), yard.robot.radius_m - 2e-9);
    }
  }
}

/// The numbers of a drive agree with its waypoints.
void expect_consistent(const Yard& yard, const Routes& routes, std::size_t i, std::size_t j) {
  const Drive drive = routes.between(i, j);
  const std::vector<Vec2> points = routes.waypoints(i, j);
  if (!std::isfinite(drive.time_s)) {
    EXPECT_TRUE(points.empty());
    return;
  }
  ASSERT_EQ(points.front(), yard.stops[i]);
  if (points.size() == 1) {
    EXPECT_EQ(drive.time_s, 0.0);
    return;
  }
  ASSERT_EQ(points.back(), yard.stops[j]);
  const DriveCost cost = drive_cost(yard.robot, drive.departure_rad, points);
  EXPECT_NEAR(cost.time_s, drive.time_s, 1e-6);  // a rounded departure still turns a little: sqrt(1e-16)
  EXPECT_NEAR(wrap_angle(heading_of(points[1] - points[0]) - drive.departure_rad), 0.0, 1e-12);
  EXPECT_NEAR(wrap_angle(cost.heading_rad - drive.arrival_rad), 0.0, 1e-12);
}

// ---- Right --------------------------------------------------------------------------------------

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

TEST(Routes, ARouteFromTheBestHeadingTakesTheTimeOfTheTable) {
  const Yard yard = big_yard(9, 60, 12);
  const auto routes = routes_of(yard);
  ASSERT_TRUE(routes);
  for (std::size_t i = 0; i < yard.stops.size(); ++i) {
    for (std::size_t j = 0; j < yard.stops.size(); ++j) {
      const Drive drive = routes->between(i, j);
      if (i == j || drive.time_s == inf) continue;
      const auto route = routes->route({yard.stops[i], drive.departure_rad}, yard.stops[j]);
      ASSERT_TRUE(route);
      EXPECT_NEAR(route->cost.time_s, drive.time_s, 1e-6);
    }
  }
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

// ---- At the edges -------------------------------------------------------------------------------

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

// ---- Refused ------------------------------------------------------------------------------------

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
  EXPECT_EQ(routes_of(yard, std::vector<Vec2>(5000, Vec2{})).error().code, FaultCode::bad_input);
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
  for (int i = 0; i < 900; ++i)
    yard.obstacles.push_back({{{3.0 * (i % 30) - 45.0, 3.0 * (i / 30) - 45.0}}, 0.2});
  const auto routes = routes_of(yard);
  ASSERT_FALSE(routes);
  EXPECT_EQ(routes.error().code, FaultCode::bad_input);
  EXPECT_NE(routes.error().sentence.find("4096"), std::string::npos);
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
