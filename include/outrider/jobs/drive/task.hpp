// DriveTask: everything that a robot on wheels knows about its drive.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/control/calibration.hpp"
#include "outrider/control/follow_waypoints.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/localise.hpp"
#include "outrider/jobs/drive/localisation/dead_reckoning.hpp"
#include "outrider/slam/map/map_localiser.hpp"
#include "outrider/world/world.hpp"
#include "outrider/world/zone.hpp"

namespace outrider {

/// The camera and its mount. It looks straight ahead.
struct TagEye {
  Camera camera;             ///< intrinsic parameters
  double ahead_m = 0.0;      ///< in front of the robot's centre
  double height_m = 0.2;     ///< above the floor
  double rate_hz = 10.0;     ///< images per second
  double exposure_s = 0.01;  ///< exposure time
  double latency_s = 0.0;    ///< longest time from an exposure until its tags are known
};
/// Describes the options by name.
std::vector<Option> describe(TagEye& eye);
/// Returns the camera with its pose on the robot.
RobotCamera robot_camera(const TagEye& eye);

/// When the mission uses images, waits and gives up.
struct DriveRules {
  double period_s = 0.05;      ///< control period; images older than their latency and half of it are ignored
  double settle_s = 0.5;       ///< time to stand at a stop before it counts as reached
  double most_settle_s = 4.0;  ///< after this time it is unconfirmed, and the robot goes on
  std::int64_t settle_sightings =
      3;                            ///< images at a stop whose tags are accepted before it counts as reached
  double settle_sigma_m = 0.006;    ///< largest standard deviation of the position at a stop
  double settle_sigma_rad = 0.006;  ///< the same for the heading
  bool tags_move = true;            ///< tags may be moved during the drive: one alone confirms no stop if the
                          ///< belief was too wide to contradict it; the robot looks for a second one
  double patience_s = 120.0;      ///< longest time for one waypoint
  std::int64_t hold_refused = 3;  ///< images in a row with impossible tags after which the robot stands still
  std::int64_t relocalise = 5;    ///< images that have to agree on where it is then
  std::int64_t most_refused = 30;  ///< images in a row with impossible tags after which the robot is lost
  double rest_s = 1.0;             ///< rest between two motions of the open loop
};
/// Describes the options by name.
std::vector<Option> describe(DriveRules& rules);

/// The settings.
struct DriveTask {
  World world;                         ///< obstacles
  TagMap tags;                         ///< poses of the tags
  std::optional<KnownMap> known = {};  ///< the map that a robot with a laser has
  std::vector<Zone> zones = {};        ///< the zones that it keeps to
  Chassis chassis = mecanum_chassis(0.03, 0.1225);
  double radius_m = 0.15;           ///< of a disk that contains the robot
  Pose2 start;                      ///< exact
  std::vector<Waypoint> waypoints;  ///< without the start
  bool closed_loop = true;          ///< false: open loop by time
  Calibration calibration;          ///< of the wheels
  FollowOptions follow;             ///< of following waypoints
  PidGains pid;                     ///< of the controllers
  ReckoningOptions reckoning;       ///< of dead reckoning
  LocaliseOptions localise;         ///< of corrections by tags
  TagEye eye;                       ///< camera
  DriveRules rules;                 ///< limits
};

}  // namespace outrider
