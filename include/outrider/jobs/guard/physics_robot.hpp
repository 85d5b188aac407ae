// A guard as rigid bodies: wheels that push it about a yard, a ball that flies until it touches something.
//
// Legs and turns are those of the ordinary simulator, under the same speed profiles, but the wheels follow
// them and the engine says where the robot is. Each drive is sent off its goal by the error of position that
// the problem states, and each shot leaves with the errors of the gun; what the wheels miss of the goal comes
// on top and is measured. The barrel is a part of the report only: the ball starts at the muzzle of
// the chassis as it stands in the engine, and touches what it touches there.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/jobs/guard/rigid_world.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/record.hpp"

namespace outrider {

class PhysicsGuard final : public Robot {
 public:
  /// The references must outlive the robot. It is let down on its wheels before the clock begins.
  PhysicsGuard(const GuardProblem& problem, const FiringMap& firing_map, RigidWorld& bodies,
               std::uint64_t seed);

  Observation sense() override;
  void act(const Command& command) override;

  SimRecord record;  ///< so far, with what rigid bodies tell

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
  void log(std::string kind, std::string text);
  [[nodiscard]] double now_s() const;
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] Flight launched(const Shot& shot) const;
  [[nodiscard]] Impact thrown(const Flight& flight, std::size_t target);
  [[nodiscard]] std::string name_of(std::size_t body) const;
  [[nodiscard]] std::string contact_of(const Impact& impact, std::size_t target) const;

  const GuardProblem& problem_;
  const FiringMap& site_;
  RigidWorld& bodies_;
  WheelBase wheels_;
  Rng arrival_rng_;
  Rng gun_rng_;
  std::int64_t ticks_ = 0;
  double gun_yaw_rad_ = 0.0;  // relative to the body
  double gun_pitch_rad_ = 0.0;
  std::vector<ShotResult> landed_;   // not yet told of
  std::vector<int> attempts_;        // by target
  std::vector<std::size_t> bumped_;  // in this drive
};

}  // namespace outrider
