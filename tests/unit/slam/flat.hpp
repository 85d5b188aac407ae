// A simulated flat whose walls, and so the true pose, are known, and a robot that wanders in it.
#pragma once

#include <algorithm>
#include <array>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/map/map_localiser.hpp"

namespace outrider::testing {

constexpr double room_m = 4.0;
constexpr Finder flat_finder{.most_m = 8.0};

inline void add_box(std::vector<Wall>& walls, Vec2 low, Vec2 high) {
  for (const Wall& wall : box_walls(low, high)) walls.push_back(wall);
}

/// A flat of 3 x 2 rooms of 4 m with a door of 1 m between neighbours, and furniture in each room.
inline std::vector<Wall> flat(Rng& rng) {
  std::vector<Wall> walls = box_walls({0, 0}, {3 * room_m, 2 * room_m});
  const auto door = [&] { return rng.uniform(0.4, room_m - 1.4); };
  for (int row = 0; row < 2; ++row) {
    for (int column = 1; column < 3; ++column) {
      const double x = column * room_m, y = row * room_m, at = y + door();
      walls.push_back({{x, y}, {x, at}});
      walls.push_back({{x, at + 1.0}, {x, y + room_m}});
    }
  }
  for (int column = 0; column < 3; ++column) {
    const double x = column * room_m, at = x + door();
    walls.push_back({{x, room_m}, {at, room_m}});
    walls.push_back({{at + 1.0, room_m}, {x + room_m, room_m}});
  }
  for (int room = 0; room < 6; ++room) {
    const Vec2 corner{room_m * (room % 3), room_m * (room / 3)};
    for (int i = 0; i < 3; ++i) {
      const Vec2 low = corner + Vec2{rng.uniform(0.1, 3.0), rng.uniform(0.1, 3.0)};
      add_box(walls, low, low + Vec2{rng.uniform(0.2, 0.8), rng.uniform(0.2, 0.8)});
    }
  }
  return walls;
}

inline double room_around(const std::vector<Wall>& walls, Vec2 place) {
  double least_m = 1e9;
  for (int i = 0; i < 32; ++i)
    least_m = std::min(least_m, ray_range(walls, place, direction(i * radians(360.0 / 32))));
  return least_m;
}

inline Pose2 place_in(const std::vector<Wall>& walls, Rng& rng) {
  for (;;) {
    const Vec2 place{rng.uniform(0.0, 3 * room_m), rng.uniform(0.0, 2 * room_m)};
    if (room_around(walls, place) > 0.45) return {place, rng.uniform(-pi, pi)};
  }
}

/// The map of the walls, drawn from known poses.
inline KnownMap known_map(const std::vector<Wall>& walls, Rng& rng) {
  OccupancyMap map({});
  for (int i = 0; i < 300; ++i) {
    const Pose2 pose = place_in(walls, rng);
    map.insert(pose, scan_from(walls, pose, flat_finder, rng));
  }
  return {map.occupancy(), 0.0};
}

/// A robot that drives straight on and turns away where something is near. Its wheels are off by a percent.
class Wanderer {
 public:
  Wanderer(const std::vector<Wall>& walls, Rng& rng) : walls_(walls), rng_(rng), pose(place_in(walls, rng)) {}

  /// Drives for one step and returns the motion by odometry.
  Pose2 step() {
    constexpr double step_m = 0.06, step_rad = 0.3, ahead_m = 0.6;
    const bool is_free = std::ranges::all_of(std::array{-0.5, -0.25, 0.0, 0.25, 0.5}, [&](double turn) {
      return ray_range(walls_, pose.position, direction(pose.heading_rad + turn)) > ahead_m;
    });
    if (is_free) turning_ = 0.0;
    if (!is_free && turning_ == 0.0) turning_ = rng_.below(2) == 0 ? 1.0 : -1.0;
    const Pose2 motion{{is_free ? step_m : 0.0, 0.0}, is_free ? 0.02 * rng_.normal() : turning_ * step_rad};
    pose = compose(pose, motion);
    way_m += norm(motion.position);
    return {1.01 * motion.position, motion.heading_rad * (0.99 + 0.01 * rng_.normal())};
  }

 private:
  const std::vector<Wall>& walls_;
  Rng& rng_;
  double turning_ = 0.0;

 public:
  Pose2 pose;
  double way_m = 0.0;
};

/// Moves a robot to another place, at least 3 m away, without telling it.
inline void kidnap(Wanderer& robot, const std::vector<Wall>& walls, Rng& rng) {
  const Pose2 before = robot.pose;
  while (distance(robot.pose.position, before.position) < 3.0) robot.pose = place_in(walls, rng);
}

}  // namespace outrider::testing
