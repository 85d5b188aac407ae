// RigidBody: a robot on driven wheels in a rigid world, which drives to waypoints, and the balls that it
// throws.
//
// Legs and turns have the speed profiles of a WaypointBody, but here they are references that the wheels
// follow, and the physics engine determines the motion of the robot. The goal of each drive has a random
// error of position added; the tracking error of the wheels comes on top and is measured. Whatever takes time
// steps the engine: 1 ms at a time, or 0.25 ms while balls fly. The barrel is not a body: a ball starts at
// the position that the muzzle has for the pose of the chassis, and the engine detects its contacts.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/sim/bodies/waypoint_body.hpp"
#include "outrider/sim/record.hpp"
#include "outrider/sim/rigid/rigid_world.hpp"
#include "outrider/sim/simulated_gun.hpp"

namespace outrider {

/// A ball that has touched something.
struct LandedBall {
  FiredShot shot;
  Impact impact;        ///< `solid` is the index of a body of the world
  double landed_s = 0;  ///< when the contact was found
};

/// The robot touches a body for the first time in a drive.
struct Bump {
  double time_s = 0.0;
  Vec2 position;
  std::size_t body = 0;
};

class RigidBody {
 public:
  /// The world is that of the scene. The ground must outlive the body. The robot settles on its wheels before
  /// time 0.
  RigidBody(std::unique_ptr<RigidWorld> world, RigidScene scene, const BodyGround& on,
            const ExecutionErrors& errors, const Rng& rng);

  // ---- Driving: as a WaypointBody does it -----------------------------------------------------------

  std::vector<Vec2> displaced_waypoints(std::vector<Vec2> waypoints);
  void begin_way() { bumped_.clear(); }
  StraightDrive begin_straight(Vec2 goal, const std::function<void()>& sample);
  void be_on(const StraightDrive& drive, double after_s);
  [[nodiscard]] Platform platform_on(const StraightDrive& drive, double after_s) const;
  void end_straight(const StraightDrive& drive);
  void end_way() { record_.arrival_errors_m.push_back(distance(pose_.position, goal_)); }
  void wait_until(double time_s);

  [[nodiscard]] double time_s() const { return tick_s * static_cast<double>(ticks_); }
  [[nodiscard]] const Pose2& pose() const { return pose_; }  ///< world_T_robot; heading wrapped
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  [[nodiscard]] double position_error_m() const { return errors_.position_m; }
  [[nodiscard]] Stance stance_on(Vec2, Vec2, double) const { return {}; }  ///< the floor is level

  // Nothing holds it up, and commands take no time before they are carried out.
  [[nodiscard]] std::optional<double> stopped_after_s(const StraightDrive&) const { return {}; }
  void cut_short(const StraightDrive&, double) {}
  [[nodiscard]] bool stopped() const { return false; }
  bool suffer() { return false; }
  double begin(const Command&) const { return time_s(); }
  void run_until(double) {}
  [[nodiscard]] Twist2 twist() const { return {}; }

  // ---- Balls ----------------------------------------------------------------------------------------

  /// Returns the flight of a shot from the muzzle of the chassis as it is now, without its own velocity.
  [[nodiscard]] Flight launched(const GunModel& gun, const Shot& shot) const;
  /// Returns the velocity of a point of the world that is fixed to the robot, m/s.
  [[nodiscard]] Vec3 velocity_at(Vec3 point) const { return world_->velocity_at(point); }
  /// True if the engine holds no more balls.
  [[nodiscard]] bool full() const { return balls_.size() == most_balls; }
  /// Throws a ball. Call it only if the world is not full.
  void throw_ball(FiredShot shot);
  /// Stands still until the newest ball has landed.
  void wait_until_landed();
  /// Return what has happened since the call before, in the order of time.
  std::vector<LandedBall> take_landed() { return std::exchange(landed_, {}); }
  std::vector<Bump> take_bumps() { return std::exchange(bumps_, {}); }
  /// Returns a time before which no shot is still in the air.
  [[nodiscard]] double all_landed_before_s() const;
  [[nodiscard]] const std::string& name_of(std::size_t body) const;

  RigidRecord& record() { return record_; }

 private:
  static constexpr double tick_s = 0.25e-3;  // a step of a flight: a ball at 10 m/s moves 2.5 mm

  struct BallInAir {
    std::size_t number = 0;  // in the engine
    FiredShot shot;
    std::int64_t fired_at = 0;  // ticks
    Vec3 before;                // where it was before the last step
  };

  void turn_to(double heading_rad, const std::function<void()>& sample);
  template <class ReferenceAt, class During>
  void track(double begin_s, double total_s, const ReferenceAt& at, const During& during);
  void roll();
  void tick();
  void look();
  void land_balls();
  [[nodiscard]] std::optional<Impact> impact_of(const BallInAir& ball) const;

  std::unique_ptr<RigidWorld> world_;
  RigidScene scene_;
  BodyGround on_;
  ExecutionErrors errors_;
  Rng rng_;
  std::int64_t ticks_ = 0;
  Pose2 pose_;
  Vec2 goal_;  // of the present drive
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
  std::vector<BallInAir> balls_;  // in the order in which they were fired
  std::vector<LandedBall> landed_;
  std::vector<std::size_t> bumped_;  // in this drive
  std::vector<Bump> bumps_;
  RigidRecord record_;
};

}  // namespace outrider
