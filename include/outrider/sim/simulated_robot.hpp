// SimulatedRobot: a body that moves, and the devices that it carries, behind the port.
//
// A body is a class of its own with begin(command), which returns when the command will be carried out,
// run_until(time), and the truth about its motion. A device looks from the true pose of the body, either when
// the robot senses or at times of its own; somebody may put the robot elsewhere (WheelBody only). To add one,
// add a class, and a row of the variant or a member of SimulatedDevices.
//
// Same bodies, devices and commands: same observations.
#pragma once

#include <optional>
#include <span>
#include <variant>

#include "outrider/robot/robot.hpp"
#include "outrider/sim/piece_body.hpp"
#include "outrider/sim/record.hpp"
#include "outrider/sim/simulated_gun.hpp"
#include "outrider/sim/simulated_laser.hpp"
#include "outrider/sim/simulated_stores.hpp"
#include "outrider/sim/simulated_tag_camera.hpp"
#include "outrider/sim/simulated_targets.hpp"
#include "outrider/sim/twist_body.hpp"
#include "outrider/sim/waypoint_body.hpp"
#include "outrider/sim/wheel_body.hpp"

namespace outrider {

using SimulatedBody = std::variant<TwistBody, WheelBody, PieceBody, WaypointBody>;

struct SimulatedDevices {
  std::optional<SimulatedLaser> laser = {};
  std::optional<SimulatedTagCamera> camera = {};
  std::optional<SimulatedGun> gun = {};          ///< on a WaypointBody
  std::optional<SimulatedStores> stores = {};    ///< on a WaypointBody
  std::optional<SimulatedTargets> targets = {};  ///< their detector
};

class SimulatedRobot final : public Robot {
 public:
  explicit SimulatedRobot(SimulatedBody body, SimulatedDevices devices = {},
                          const Kidnapping& kidnapping = {});

  Observation sense() override;
  void act(const Command& command) override;

  [[nodiscard]] double time_s() const;
  [[nodiscard]] const Pose2& pose() const;  ///< world_T_robot, the truth; heading not wrapped
  /// The body, which is of that class.
  template <class Body>
  [[nodiscard]] const Body& body() const {
    return std::get<Body>(body_);
  }
  [[nodiscard]] const SimulatedDevices& devices() const { return devices_; }

  SimRecord record;  ///< of a WaypointBody, so far

 private:
  void run_until(double time_s);
  // gun_commands.cpp
  void act_on(WaypointBody& body, const Command& command);
  void follow(WaypointBody& body, const FollowWaypoints& command);
  void drive_straight(WaypointBody& body, Vec2 goal, std::span<const FireInPassing> shots);
  void aim(WaypointBody& body, const AimGun& command);
  void fire(WaypointBody& body, const Fire& command);
  void wait(WaypointBody& body, const Wait& command);
  void fill(WaypointBody& body, const Fill& command);
  void await_balls(WaypointBody& body);
  Impact shoot(const Fire& command, Vec2 velocity_mps);
  void sample();
  void gauge();

  SimulatedBody body_;
  SimulatedDevices devices_;
  Kidnapping kidnapping_;
  bool kidnapped_ = false;
  std::vector<ShotResult> landed_;  // not yet told of
};

/// A robot on two wheels with a bumper and a range finder, at rest at the start.
SimulatedRobot simulated_explorer(const World& world, const Pose2& start, const RobotModel& robot,
                                  const ExplorerSimParams& params, std::uint64_t seed);

}  // namespace outrider
