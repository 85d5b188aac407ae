#include "routes_twin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_cases.hpp"

namespace outrider::testing {

RoundedPolygon box(Vec2 centre, double half_x, double half_y, double yaw_rad) {
  const Vec2 u = half_x * direction(yaw_rad);
  const Vec2 v = half_y * perpendicular(direction(yaw_rad));
  return {{centre - u - v, centre + u - v, centre + u + v, centre - u + v}, 0.0};
}

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

namespace {

/// A corner, and the polygon that it belongs to.
struct Corner {
  Vec2 at;
  RoundedPolygon of;
};

std::vector<Corner> free_corners(const Yard& yard, double step_rad) {
  std::vector<Corner> found;
  for (const RoundedPolygon& obstacle : yard.obstacles) {
    for (const double step : {step_rad, std::min(2.0 * step_rad, pi / 2)}) {
      const auto corners = circumscribed({obstacle.core, obstacle.radius_m + yard.robot.radius_m}, step);
      for (const Vec2 c : corners) {
        if (twin_clearance(yard, c) >= yard.robot.radius_m - 1e-9) found.push_back({c, {corners, 0.0}});
      }
    }
  }
  return found;
}

/// The leg enters the polygon neither just before the corner nor, gone on straight, just behind it.
bool twin_touches(const Corner& corner, Vec2 place) {
  const Vec2 step = (1e-3 / distance(place, corner.at)) * (corner.at - place);
  return signed_distance(corner.at + step, corner.of) >= -1e-11 &&
         signed_distance(corner.at - step, corner.of) >= -1e-11;
}

}  // namespace

std::vector<Vec2> twin_nodes(const Yard& yard, double step_rad) {
  std::vector<Vec2> nodes;
  for (const Corner& corner : free_corners(yard, step_rad)) nodes.push_back(corner.at);
  return nodes;
}

Twin::Twin(const Yard& yard, double step_rad, const std::vector<Vec2>& extra)
    : robot(yard.robot), points(twin_nodes(yard, step_rad)) {
  const std::vector<Corner> corners = free_corners(yard, step_rad);
  points.insert(points.end(), extra.begin(), extra.end());
  nodes = points.size();
  points.insert(points.end(), yard.stops.begin(), yard.stops.end());
  seen.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (distance(points[i], points[j]) <= 1e-9 || !twin_leg_free(yard, {points[i], points[j]})) continue;
      if (i < corners.size() && !twin_touches(corners[i], points[j])) continue;
      if (j < corners.size() && !twin_touches(corners[j], points[i])) continue;
      seen[i].push_back(j);
    }
  }
}

std::vector<double> Twin::times_from(std::size_t stop, const double* heading_rad) const {
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

Yard random_yard(Rng& rng, int obstacles, int stops, const RobotModel& robot) {
  Yard yard;
  yard.robot = robot;
  for (int i = 0; i < obstacles; ++i) {
    const Vec2 centre = random_point(rng, 3.0);
    if (rng.below(3) == 0) {
      yard.obstacles.push_back({{centre}, rng.uniform(0.05, 0.5)});
    } else {
      yard.obstacles.push_back(box(centre, rng.uniform(0.05, 1.2), rng.uniform(0.05, 0.3),
                                   rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, pi)));
    }
  }
  for (int tries = 0; static_cast<int>(yard.stops.size()) < stops && tries < 1000; ++tries) {
    const Vec2 p = random_point(rng, 3.0);
    if (twin_clearance(yard, p) >= yard.robot.radius_m) yard.stops.push_back(p);
  }
  return yard;
}

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
    const Vec2 centre = random_point(rng, 10.0);
    if (i % 4 == 0) {
      yard.obstacles.push_back({{centre}, rng.uniform(0.05, 0.4)});
    } else {
      yard.obstacles.push_back(box(centre, rng.uniform(0.05, i % 7 == 0 ? 2.5 : 0.6), rng.uniform(0.05, 0.6),
                                   rng.uniform(0.0, 2.0 * pi)));
    }
  }
  while (static_cast<int>(yard.stops.size()) < stops) {
    const Vec2 p = random_point(rng, 10.0);
    if (twin_clearance(yard, p) >= yard.robot.radius_m) yard.stops.push_back(p);
  }
  return yard;
}

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

Outcome<Routes> routes_of(const Yard& yard, const std::vector<Vec2>& extra, const RouteOptions& options,
                          const Budget& budget) {
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

}  // namespace outrider::testing
