// Rooms of straight walls, and what a range finder sees in them: the truth that laser mapping is held
// against.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider::testing {

struct Wall {
  Vec2 a;
  Vec2 b;
};

inline std::vector<Wall> box_walls(Vec2 low, Vec2 high) {
  return {{low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
}

/// Walls around a room of 6 m by 4 m with three things in it: no two places look alike.
inline std::vector<Wall> furnished_room() {
  std::vector<Wall> walls = box_walls({0, 0}, {6, 4});
  for (const auto& [low, high] :
       {std::pair<Vec2, Vec2>{{1, 1}, {1.6, 1.3}}, {{4, 2.2}, {4.3, 3.1}}, {{3, 0}, {3.2, 0.9}}}) {
    for (const Wall& wall : box_walls(low, high)) walls.push_back(wall);
  }
  return walls;
}

/// From p to the nearest wall along a direction; infinite where there is none.
inline double ray_range(const std::vector<Wall>& walls, Vec2 p, Vec2 along) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) {
    const Vec2 side = wall.b - wall.a;
    const double det = cross(along, side);
    if (det == 0.0) continue;
    const double t = cross(wall.a - p, side) / det;
    const double s = cross(wall.a - p, along) / det;
    if (t > 0.0 && s >= 0.0 && s <= 1.0) nearest = std::min(nearest, t);
  }
  return nearest;
}

struct Finder {
  int beams = 360;
  double first_rad = -3.141592653589793;
  double step_rad = 0.017453292519943295;
  double most_m = 3.5;
  double noise_m = 0.01;
};

inline LaserScan scan_from(const std::vector<Wall>& walls, const Pose2& pose, const Finder& finder,
                           Rng& rng) {
  LaserScan scan{0.0, finder.first_rad, finder.step_rad, 0.12, finder.most_m, {}};
  for (int i = 0; i < finder.beams; ++i) {
    const double range_m =
        ray_range(walls, pose.position, direction(pose.heading_rad + finder.first_rad + i * finder.step_rad));
    const bool hits = range_m <= finder.most_m;
    scan.ranges_m.push_back(hits ? static_cast<float>(range_m + finder.noise_m * rng.normal())
                                 : std::numeric_limits<float>::infinity());
  }
  return scan;
}

/// A corridor of 1.6 m about a block: its length is hard to tell from within.
inline std::vector<Wall> ring() {
  std::vector<Wall> walls = box_walls({0, 0}, {13, 9});
  for (const Wall& wall : box_walls({1.6, 1.6}, {11.4, 7.4})) walls.push_back(wall);
  for (const Vec2 post : {Vec2{1.5, 0.1}, {6.0, 0.1}, {12.7, 4.0}}) {
    for (const Wall& wall : box_walls(post, post + Vec2{0.2, 0.2})) walls.push_back(wall);
  }
  return walls;
}

/// A robot that drives along corners at 0.22 m/s and turns in place at 1.5 rad/s, sensing at 5 Hz; its wheels
/// are off by `wheel_bias`, one up and one down, and by a little noise.
struct Drive {
  std::vector<Pose2> poses;
  std::vector<Pose2> motions;
};
inline Drive drive_along(const std::vector<Vec2>& corners, double heading_rad, Rng& rng,
                         double wheel_bias = 0.01) {
  constexpr double period_s = 0.2;
  constexpr double wheels_apart_m = 0.16;
  Drive drive;
  Pose2 pose{corners.front(), heading_rad};
  const auto go = [&](double way_m, double turn_rad) {
    pose = compose(pose, {{way_m, 0.0}, turn_rad});
    const double right = (way_m + 0.5 * wheels_apart_m * turn_rad) * (1.0 + wheel_bias + 0.01 * rng.normal());
    const double left = (way_m - 0.5 * wheels_apart_m * turn_rad) * (1.0 - wheel_bias + 0.01 * rng.normal());
    drive.poses.push_back(pose);
    drive.motions.push_back({{0.5 * (right + left), 0.0}, (right - left) / wheels_apart_m});
  };
  go(0.0, 0.0);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    double turn = wrap_angle(heading_of(corners[i] - pose.position) - pose.heading_rad);
    for (const double step = 1.5 * period_s; std::abs(turn) > 1e-9;) {
      const double part = std::clamp(turn, -step, step);
      go(0.0, part);
      turn -= part;
    }
    double way = distance(corners[i], pose.position);
    for (const double step = 0.22 * period_s; way > 1e-9;) {
      const double part = std::min(way, step);
      go(part, 0.0);
      way -= part;
    }
  }
  return drive;
}

}  // namespace outrider::testing
