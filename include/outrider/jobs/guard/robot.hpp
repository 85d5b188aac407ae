// Robot: the port behind which a simulator, a bridge or hardware does what a mission commands.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/jobs/guard/supplies.hpp"

namespace outrider {

/// An intruder that goes to a place: it has just entered, or it was hit and did not leave.
struct Sighting {
  std::size_t target = 0;
  double settles_s = 0.0;  ///< when it is there
  std::size_t place = 0;
};

/// Where somebody who wanders was seen.
struct Glimpsed {
  std::size_t target = 0;
  double time_s = 0.0;
  Vec2 position;
};

/// What has become of a shot in passing.
struct PassingResult {
  std::size_t target = 0;
  bool hit = false;
  double landed_s = 0.0;
};

/// What the robot knows of itself, and of those who have entered.
struct Observation {
  double time_s = 0.0;
  Pose2 pose;
  double gun_yaw_rad = 0.0;  ///< relative to the body
  double gun_pitch_rad = 0.0;
  std::optional<bool> hit;                 ///< whether the last shot hit; set once, right after it
  std::vector<Sighting> entered = {};      ///< or gone elsewhere, since the last observation
  bool nobody_comes = true;                ///< nobody will enter any more
  std::vector<Glimpsed> glimpses = {};     ///< since the last observation
  std::vector<PassingResult> passed = {};  ///< of the shots in passing since then
  double water = std::numeric_limits<double>::infinity();     ///< in the tank
  double charge_j = std::numeric_limits<double>::infinity();  ///< in the battery
};

/// A shot from a robot that drives: turn the barrel there while driving, from the beginning of the straight
/// or from the shot before on it, and shoot at that moment.
struct FireInPassing {
  std::size_t target = 0;
  std::size_t leg = 0;   ///< the straight to this waypoint
  double after_s = 0.0;  ///< since it has begun
  Shot shot;             ///< of the barrel; the ball has the velocity of the robot beside
};

/// Turn towards each waypoint in place, drive straight to it, come to rest at the last.
struct FollowWaypoints {
  std::vector<Vec2> waypoints;            ///< the first is where the robot stands
  bool until_news = false;                ///< end at the next waypoint once somebody has entered
  std::vector<FireInPassing> shots = {};  ///< in order; the command ends when their balls have landed
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
/// Fill a store to the brim at the station where the robot stands.
struct Fill {
  StationCall call;
};
using Command = std::variant<FollowWaypoints, AimGun, Fire, Wait, Fill>;

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
