// Rooms of straight walls, and what a range finder sees in them: the truth that laser mapping is held
// against.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/laser_scan.hpp"

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

}  // namespace outrider::testing
