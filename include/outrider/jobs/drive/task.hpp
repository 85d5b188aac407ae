// DriveTask: all that a robot on wheels knows of where to drive and how.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "outrider/control/calibration.hpp"
#include "outrider/control/follow_waypoints.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/localise.hpp"
#include "outrider/jobs/drive/dead_reckoning.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// The camera and how it is carried; it looks straight ahead.
struct TagEye {
  Camera camera;
  double ahead_m = 0.0;  ///< of the robot's middle
  double height_m = 0.2;
  double rate_hz = 10.0;
  double exposure_s = 0.01;
};
std::vector<Option> describe(TagEye& eye);
RobotCamera robot_camera(const TagEye& eye);

/// When the executor looks, waits and gives up.
struct DriveRules {
  double period_s = 0.05;         ///< of control; a tag pose older than half of it is not used
  double settle_s = 0.5;          ///< of standing at a stop before it counts as reached
  double most_settle_s = 4.0;     ///< after which it counts although the belief is still wide
  double settle_sigma_m = 0.006;  ///< what is wide
  double settle_sigma_rad = 0.006;
  double patience_s = 120.0;       ///< for one waypoint
  std::int64_t most_refused = 10;  ///< images in a row whose tags are where they cannot be
  double rest_s = 1.0;             ///< between two motions of the open loop
};
std::vector<Option> describe(DriveRules& rules);

struct DriveTask {
  World world;
  TagMap tags;
  Chassis chassis = mecanum_chassis(0.03, 0.1225);
  double radius_m = 0.15;  ///< of the disk that the robot stays within
  Pose2 start;
  std::vector<Waypoint> waypoints;  ///< the start is none
  bool closed_loop = true;
  Calibration calibration;
  FollowOptions follow;
  PidGains pid;
  ReckoningOptions reckoning;
  LocaliseOptions localise;
  TagEye eye;
  DriveRules rules;
};

}  // namespace outrider
