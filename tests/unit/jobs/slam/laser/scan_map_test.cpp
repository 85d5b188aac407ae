#include "laser/scan_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/job/log_map.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

/// How far it is to the walls of a room of 6 x 4 m, or to a pillar in it.
double range_in_room(Vec2 from, double bearing_rad) {
  const Vec2 d = direction(bearing_rad);
  double range = std::numeric_limits<double>::infinity();
  const auto wall = [&](double along, double speed) {
    if (speed > 1e-12) range = std::min(range, along / speed);
  };
  wall(6.0 - from.x, d.x);
  wall(from.x, -d.x);
  wall(4.0 - from.y, d.y);
  wall(from.y, -d.y);
  const Vec2 to = Vec2{3.0, 2.6} - from;
  const double nearest = dot(to, d), aside2 = norm(to) * norm(to) - nearest * nearest;
  if (nearest > 0.0 && aside2 < 0.09) range = std::min(range, nearest - std::sqrt(0.09 - aside2));
  return range;
}

LaserScan scan_from(const Pose2& pose, double time_s) {
  LaserScan scan{time_s, -pi, radians(3.0), 0.02, 8.0, {}};
  for (int i = 0; i < 120; ++i) {
    scan.ranges_m.push_back(static_cast<float>(
        range_in_room(pose.position, pose.heading_rad + scan.first_rad + i * scan.step_rad)));
  }
  return scan;
}

/// Rounds on a circle in the room; the wheels count too little.
struct Rounds {
  std::vector<Pose2> poses;
  std::vector<Pose2> motions;  ///< by odometry
  std::vector<LaserScan> scans;

  explicit Rounds(int steps) {
    for (int i = 0; i < steps; ++i) {
      const double angle = 0.08 * i;
      poses.push_back({Vec2{3.0, 1.6} + 1.0 * direction(angle - 0.5 * pi), wrap_angle(angle)});
      const Pose2 motion =
          i == 0 ? Pose2{} : wrap_heading(relative_pose(poses[poses.size() - 2], poses.back()));
      motions.push_back({0.97 * motion.position, motion.heading_rad + 0.002});
      scans.push_back(scan_from(poses.back(), 0.5 * i));
    }
  }
};

TEST(ScanMap, IsThatOfTheMapper) {
  const Rounds rounds(100);
  LaserSlamOptions options;
  options.draw_late = true;
  options.robot_T_laser = {{0.1, -0.05}, 0.3};
  auto slam = LaserSlam::begin(options, rounds.poses.front());
  ASSERT_TRUE(slam);
  Log log;
  ScanMap map(options.map, options.robot_T_laser, 1.0);
  for (std::size_t i = 0; i < rounds.scans.size(); ++i) {
    const auto step = slam->advance(rounds.motions[i], rounds.scans[i]);
    ASSERT_TRUE(step);
    if (step->kept) map.add(log, step->pose, rounds.scans[i], rounds.scans[i].time_s);
  }
  slam->settle();
  map.finish(log, slam->map().occupancy(), rounds.scans.back().time_s);
  LogMap logged;
  std::ptrdiff_t first = -1;
  logged.read(log, [&](const Grid<std::uint8_t>& grid, bool, std::span<const std::size_t>, double) {
    if (first < 0) first = std::ssize(grid.cells) - std::ranges::count(grid.cells, unknown_cell);
  });
  EXPECT_EQ(logged.grid().frame, slam->map().frame());
  EXPECT_EQ(logged.grid().cells, slam->map().occupancy().cells);
  const auto& cells = logged.grid().cells;
  const auto known = std::ssize(cells) - std::ranges::count(cells, unknown_cell);
  EXPECT_GT(known, 5000);
  EXPECT_GT(first, 0);
  EXPECT_LT(first, known) << "it was logged while it grew";
}

}  // namespace
}  // namespace outrider
