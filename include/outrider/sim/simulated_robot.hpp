// SimulatedRobot: a Robot made of a simulated body that moves and of the devices that it carries.
//
// A body is a class with begin(command), which returns the end time of the command, run_until(time), and the
// true motion. A device measures from the true pose of the body, either when the robot senses or at its own
// rate. A kidnapping can move the robot to another place, and its clock can jump
// (WheelBody and TwistBody only). To add a body, write
// a class and add it to the variant; to add a device, write a class and add a member to SimulatedDevices.
//
// The same bodies, devices and commands give the same observations.
#pragma once

#include <optional>
#include <utility>
#include <variant>

#include "outrider/robot/robot.hpp"
#include "outrider/sim/bodies/piece_body.hpp"
#include "outrider/sim/bodies/twist_body.hpp"
#include "outrider/sim/bodies/waypoint_body.hpp"
#include "outrider/sim/bodies/wheel_body.hpp"
#include "outrider/sim/faults/clock_faults.hpp"
#include "outrider/sim/record.hpp"
#include "outrider/sim/sensors/simulated_laser.hpp"
#include "outrider/sim/sensors/simulated_tag_camera.hpp"
#include "outrider/sim/simulated_gun.hpp"
#include "outrider/sim/simulated_stores.hpp"
#include "outrider/sim/simulated_targets.hpp"

namespace outrider {

using SimulatedBody = std::variant<TwistBody, WheelBody, PieceBody, WaypointBody>;

/// The devices of a robot; each of them is optional.
struct SimulatedDevices {
  std::optional<SimulatedLaser> laser = {};
  std::optional<SimulatedTagCamera> camera = {};
  std::optional<SimulatedGun> gun = {};          ///< requires a WaypointBody
  std::optional<SimulatedStores> stores = {};    ///< requires a WaypointBody
  std::optional<SimulatedTargets> targets = {};  ///< simulated targets and their detector
};

class SimulatedRobot final : public Robot {
 public:
  explicit SimulatedRobot(SimulatedBody body, SimulatedDevices devices = {},
                          const Kidnapping& kidnapping = {}, const ClockFaults& clock = {});
  /// Makes a robot that logs its motion, its shots, its stores and what happens. The log must outlive it.
  SimulatedRobot(Log& log, WaypointBody body, SimulatedDevices devices = {});

  Observation sense() override;
  void act(const Command& given) override;

  [[nodiscard]] double time_s() const;
  [[nodiscard]] const Pose2& pose() const;  ///< true world_T_robot; heading not wrapped
  /// Returns the body. `Body` must be its class.
  template <class Body>
  [[nodiscard]] const Body& body() const {
    return std::get<Body>(body_);
  }
  [[nodiscard]] const SimulatedDevices& devices() const { return devices_; }

  /// Lets other things than the yard stop the balls of the robot (simulated_gun.hpp). It carries a gun.
  void set_ball_stops(BallStops stops) { devices_.gun->set_stops(std::move(stops)); }

  /// Returns the messages that are logged once their time has come. Others may add to them.
  LogQueue& queue() { return queue_; }

  SimRecord record;  ///< filled for a WaypointBody only

 private:
  void run_until(double time_s);
  [[nodiscard]] Command in_true_time(Command command) const;
  // gun_commands.cpp
  void act_on(WaypointBody& body, const Command& command);
  void follow(WaypointBody& body, const FollowWaypoints& command);
  void drive_straight(WaypointBody& body, const std::vector<Vec2>& waypoints, std::size_t leg,
                      const FollowWaypoints& command);
  void aim(WaypointBody& body, const AimGun& command);
  void fire(WaypointBody& body, const Fire& command);
  void wait(WaypointBody& body, const Wait& command);
  void fill(WaypointBody& body, const Fill& command);
  void turn_gun(const std::vector<Vec2>& waypoints, const FollowWaypoints& command, std::size_t shots_done);
  std::optional<Impact> shoot(const Fire& command, const Platform& platform);
  Log* log_now();
  void sample();
  void gauge();
  void tell(double time_s, std::string kind, std::string sentence);

  SimulatedBody body_;
  SimulatedDevices devices_;
  Kidnapping kidnapping_;
  ClockFaults clock_;
  bool kidnapped_ = false;
  /// A motion of the gun during a drive.
  struct GunMotion {
    GunState from;
    GunState to;
    double begin_s = 0.0;
  };
  std::optional<GunMotion> gun_motion_;
  std::vector<ShotResult> flights_;  // not yet reported, some not yet ended
  Log* log_ = nullptr;
  LogQueue queue_;       // what happens in the future
  bool waited_ = false;  // the newest event is a wait
};

/// Makes a differential-drive robot with a bumper, a range finder and perhaps a camera, at rest at the start.
SimulatedRobot simulated_explorer(const World& world, const Pose2& start, const RobotModel& robot,
                                  const ExplorerSimParams& params, std::uint64_t seed,
                                  std::optional<SimulatedTagCamera> camera = {});

}  // namespace outrider
