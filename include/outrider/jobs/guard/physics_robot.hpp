// PhysicsGuard: a guard robot in a rigid-body simulation, with driven wheels and a ball that flies until it
// touches something.
//
// Legs and turns have the same speed profiles as in the kinematic simulator, but here they are references
// that the wheels follow, and the physics engine determines the motion of the robot. The goal of each drive
// has the position error of the problem added, and each shot has the errors of the gun. The tracking error of
// the wheels comes on top and is measured. The barrel is not a body: the ball starts at the position that the
// muzzle has for the pose of the chassis in the engine, and the engine detects its contacts.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/jobs/guard/rigid_world.hpp"
#include "outrider/log/log.hpp"
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

  SimRecord record;  ///< with the measurements of rigid bodies

 private:
  void follow(const FollowWaypoints& command);
  void aim(const AimGun& command);
  void fire(const Fire& command);
  void stand(double duration_s);
  void turn_to(double heading_rad);
  void drive_to(Vec2 goal);
  template <class ReferenceAt>
  void track(double duration_s, const ReferenceAt& at);
  void roll();
  void sample();
  void tell(std::string kind, std::string sentence);
  [[nodiscard]] double now_s() const;
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] Flight launched(const Shot& shot) const;
  [[nodiscard]] Impact thrown(const Flight& flight, std::size_t target);
  [[nodiscard]] std::string name_of(std::size_t body) const;
  [[nodiscard]] std::string contact_of(const Impact& impact, std::size_t target) const;

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  RigidWorld& bodies_;
  Log& log_;
  Rng arrival_rng_;
  Rng gun_rng_;
  std::int64_t ticks_ = 0;
  double gun_yaw_rad_ = 0.0;  // relative to the body
  double gun_pitch_rad_ = 0.0;
  std::vector<ShotResult> landed_;   // not yet reported
  std::vector<int> attempts_;        // by target
  std::vector<std::size_t> bumped_;  // in this drive
};

}  // namespace outrider
