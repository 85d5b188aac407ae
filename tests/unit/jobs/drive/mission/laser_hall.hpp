// Drives by laser in a hall with a crate.
#pragma once

#include <gtest/gtest.h>

#include "outrider/jobs/drive/mission/laser_drive.hpp"

namespace outrider::laser_drive {

inline Solid crate(Vec2 middle, Vec2 size) {
  return {"crate", {{middle.x, middle.y, 0.5}, {}}, BoxShape{{0.5 * size.x, 0.5 * size.y, 0.5}}};
}

/// A hall with a crate between the start and the first waypoint.
inline DriveTask hall() {
  DriveTask task;
  task.world.name = "hall";
  task.world.bounds = {{-3, -3}, {7, 3}};
  task.world.solids = {crate({2, 3}, {10, 0.2}), crate({2, -3}, {10, 0.2}), crate({-3, 0}, {0.2, 6}),
                       crate({7, 0}, {0.2, 6}), crate({2, 0.2}, {0.6, 2.0})};
  task.waypoints = {{{{4, 0}, 0.0}, false}, {{{4, 1.5}, 1.5}}, {{{0, 0}, 3.0}}};
  task.follow.speed_mps = 0.8;
  task.follow.acceleration_mps2 = 1.5;
  task.follow.turn_rate_radps = 1.5;
  return task;
}

inline LaserDriveOptions options() {
  LaserDriveOptions options;
  options.laser.rate_hz = 10.0;
  options.laser.most_m = 8.0;
  return options;
}

inline Report driven(const DriveTask& task, const LaserDriveOptions& how, Log& log, std::uint64_t seed = 1) {
  auto report = run_laser_drive(task, 0.3, how, seed, log);
  EXPECT_TRUE(report);
  return report ? *report : Report{};
}

}  // namespace outrider::laser_drive
