// PhysicsGuard: a guard robot in a rigid-body simulation, with driven wheels and balls that fly until they
// touch something.
//
// Legs and turns have the same speed profiles as in the kinematic simulator, but here they are references
// that the wheels follow, and the physics engine determines the motion of the robot. The goal of each drive
// has the position error of the problem added, and each shot has the errors of the gun. The tracking error of
// the wheels comes on top and is measured. The barrel is not a body: a ball starts at the position that the
// muzzle has for the pose of the chassis in the engine, with the velocity that the chassis has there when it
// drives, and the engine detects its contacts. Time goes on for the robot while balls fly.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/run/rigid_world.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/record.hpp"

namespace outrider {

class PhysicsGuard final : public Robot {
 public:
  /// The references must outlive the robot. The robot settles on its wheels before time 0.
  PhysicsGuard(const GuardProblem& problem, const FiringMap& firing_map, RigidWorld& bodies, Log& log,
               std::uint64_t seed);

  Observation sense() override;
  void act(const Command& command) override;

  /// Logs the shots whose balls have landed after balls that are still in the air. Call it when nothing more
  /// will land: other shots are logged in order.
  void log_landed() { landed_shots_.flush(log_, now_s()); }

  SimRecord record;  ///< with the measurements of rigid bodies

 private:
  static constexpr double tick_s = 0.25e-3;  // a step of a flight: a ball at 10 m/s moves 2.5 mm

  struct BallInAir {
    std::size_t number = 0;  // in the engine
    std::size_t target = 0;
    int attempt = 1;
    Flight flight;
    std::int64_t fired_at = 0;  // ticks
    Pose2 robot;                // when it left, and so are the next two
    GunState gun;
    Vec2 platform_mps;
    Vec3 before;  // where it was before the last step
  };

  void follow(const FollowWaypoints& command);
  void wait(const Wait& command);
  void stand(double duration_s);
  void turn_to(double heading_rad);
  void drive_leg(const std::vector<Vec2>& waypoints, std::size_t leg, const FollowWaypoints& command);
  template <class ReferenceAt, class During>
  void track(double duration_s, const ReferenceAt& at, const During& during);
  void roll();
  void tick();
  void sample();
  void tell(std::string kind, std::string sentence);
  [[nodiscard]] double now_s() const;
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] std::string name_of(std::size_t body) const;
  // physics_gun.cpp
  void point_gun(const std::vector<Vec2>& waypoints, const FollowWaypoints& command, std::size_t shots_done);
  void turn_gun(double duration_s);
  void aim(const AimGun& command);
  void fire(const Fire& command);
  void fire_in_passing(const FireInPassing& shot);
  std::optional<std::size_t> throw_ball(std::size_t target, const Shot& meant, Vec3 platform_mps);
  [[nodiscard]] Vec3 muzzle_velocity() const;
  [[nodiscard]] Flight launched(const Shot& shot, Vec3 platform_mps) const;
  void land_balls();
  [[nodiscard]] std::optional<Impact> impact_of(const BallInAir& ball) const;
  void note_impact(const BallInAir& ball, const Impact& impact);
  [[nodiscard]] std::string contact_of(const Impact& impact, std::size_t target) const;

  RigidRecord& rigid_;  // of the record
  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  RigidWorld& bodies_;
  Log& log_;
  Rng arrival_rng_;
  Rng gun_rng_;
  Rng timing_rng_;
  std::int64_t ticks_ = 0;
  GunState gun_;                     // its yaw is relative to the body
  GunState gun_goal_;                // what it turns to
  std::vector<BallInAir> balls_;     // in the order in which they were fired
  LogQueue landed_shots_;            // after balls that are in the air still
  std::vector<ShotResult> landed_;   // not yet reported
  std::vector<int> attempts_;        // by target
  std::vector<std::size_t> bumped_;  // in this drive
};

}  // namespace outrider
