// Robot: the port behind which a simulator, a bridge or hardware does what a mission commands.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// An intruder that has just entered: the target that it will be, and when.
struct Sighting {
  std::size_t target = 0;
  double settles_s = 0.0;
};

/// What the robot knows of itself, and of those who have entered.
struct Observation {
  double time_s = 0.0;
  Pose2 pose;
  double gun_yaw_rad = 0.0;  ///< relative to the body
  double gun_pitch_rad = 0.0;
  std::optional<bool> hit;             ///< whether the last shot hit; set once, right after it
  std::vector<Sighting> entered = {};  ///< since the last observation
  bool nobody_comes = true;            ///< nobody will enter any more
};

/// Turn towards each waypoint in place, drive straight to it, come to rest at the last.
struct FollowWaypoints {
  std::vector<Vec2> waypoints;  ///< the first is where the robot stands
  bool until_news = false;      ///< end at the next waypoint once somebody has entered
};
/// Stand still until that time, or until somebody enters.
struct Wait {
  double until_s = 0.0;  ///< may be infinite
};
/// Bring the barrel to a yaw in the world and a pitch.
struct AimGun {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};
/// Shoot along the barrel.
struct Fire {
  std::size_t target = 0;
  Shot shot;
};
using Command = std::variant<FollowWaypoints, AimGun, Fire, Wait>;

class Robot {
 public:
  virtual ~Robot() = default;
  virtual Observation sense() = 0;
  /// Returns when the command is carried out.
  virtual void act(const Command& command) = 0;

 protected:
  Robot() = default;
  Robot(const Robot&) = default;
  Robot& operator=(const Robot&) = default;
};

}  // namespace outrider
