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
#include "outrider/sim/bodies/navigated_body.hpp"
#include "outrider/sim/bodies/piece_body.hpp"
#include "outrider/sim/bodies/twist_body.hpp"
#include "outrider/sim/bodies/waypoint_body.hpp"
#include "outrider/sim/bodies/wheel_body.hpp"
#include "outrider/sim/faults/clock_faults.hpp"
#include "outrider/sim/record.hpp"
#include "outrider/sim/rigid/rigid_body.hpp"
#include "outrider/sim/sensors/simulated_laser.hpp"
#include "outrider/sim/sensors/simulated_tag_camera.hpp"
#include "outrider/sim/simulated_gun.hpp"
#include "outrider/sim/simulated_stores.hpp"
#include "outrider/sim/simulated_targets.hpp"

namespace outrider {

using SimulatedBody = std::variant<TwistBody, WheelBody, PieceBody, WaypointBody, NavigatedBody, RigidBody>;

/// The devices of a robot; each of them is optional.
struct SimulatedDevices {
  std::optional<SimulatedLaser> laser = {};
  std::optional<SimulatedTagCamera> camera = {};
  std::optional<SimulatedGun> gun = {};          ///< requires a body that drives to waypoints
  std::optional<SimulatedStores> stores = {};    ///< requires a body that drives to waypoints
  std::optional<SimulatedTargets> targets = {};  ///< simulated targets and their detector
};

class SimulatedRobot final : public Robot {
 public:
  explicit SimulatedRobot(SimulatedBody body, SimulatedDevices devices = {},
                          const Kidnapping& kidnapping = {}, const ClockFaults& clock = {});
  /// Makes a robot that logs its motion, its shots, its stores and what happens. The log must outlive it.
  SimulatedRobot(Log& log, WaypointBody body, SimulatedDevices devices = {});
  SimulatedRobot(Log& log, RigidBody body, SimulatedDevices devices);
  SimulatedRobot(Log& log, NavigatedBody body, SimulatedDevices devices);

  Observation sense() override;
  void act(const Command& given) override;

  [[nodiscard]] double time_s() const;
  [[nodiscard]] const Pose2& pose() const;  ///< true world_T_robot; heading not wrapped
  /// Returns the body. `Body` must be its class.
  template <class Body>
  [[nodiscard]] const Body& body() const {
    return std::get<Body>(body_);
  }
  template <class Body>
  [[nodiscard]] Body& body() {
    return std::get<Body>(body_);
  }
  [[nodiscard]] const SimulatedDevices& devices() const { return devices_; }

  /// Lets other things than the yard stop the balls of the robot (simulated_gun.hpp). It carries a gun.
  void set_ball_stops(BallStops stops) { devices_.gun->set_stops(std::move(stops)); }

  /// Returns the messages that are logged once their time has come. Others may add to them.
  LogQueue& queue() { return queue_; }

  /// Logs the shots of a RigidBody whose balls have landed after balls that are still in the air. Call it
  /// when nothing more will land: other shots are logged in order.
  void log_landed() { landed_shots_.flush(*log_, time_s()); }

  SimRecord record;  ///< filled for a body that drives to waypoints only

 private:
  void run_until(double time_s);
  [[nodiscard]] Command in_true_time(Command command) const;
  // gun_commands.cpp
  template <class Body>
  void begin(Body& body);
  template <class Body>
  void act_on(Body& body, const Command& command);
  template <class Body>
  void follow(Body& body, const FollowWaypoints& command);
  void follow(NavigatedBody& body, const FollowWaypoints& command);
  template <class Body>
  void drive_straight(Body& body, const std::vector<Vec2>& waypoints, std::size_t leg,
                      const FollowWaypoints& command);
  template <class Body>
  void aim(Body& body, const AimGun& command);
  template <class Body>
  void fire(Body& body, const Fire& command);
  template <class Body>
  void wait(Body& body, const Wait& command);
  template <class Body>
  void note_put(Body& body);
  template <class Body>
  void fill(Body& body, const Fill& command);
  template <class Body>
  void turn_gun(const Body& body, const std::vector<Vec2>& waypoints, const FollowWaypoints& command,
                std::size_t shots_done);
  template <class Body>
  bool shoot(Body& body, const Fire& command, const Platform& platform);
  template <class Body>
  bool throw_ball(const Body& from, const Fire& command, const Platform& platform);
  FiredShot note_fired(const Fire& command, const Platform& platform, const Flight& flight, double muzzle_mps,
                       const std::string& name);
  void tell_impact(double time_s, bool hit, const std::string& name, const std::string& miss);
  template <class Body>
  void gauge(Body& body);
  [[nodiscard]] Stance stance() const;
  [[nodiscard]] Shot barrel() const;
  Log* log_now();
  void sample();
  void tell(double time_s, std::string kind, std::string sentence);
  // rigid/landed_shots.cpp
  bool throw_ball(RigidBody& body, const Fire& command, const Platform& platform);
  void note_landed();
  void note_landed(RigidBody& body);
  void note_landed(RigidBody& body, const LandedBall& ball);

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
  LogQueue queue_;         // what happens in the future
  LogQueue landed_shots_;  // of a RigidBody, after balls that are in the air still
  bool waited_ = false;    // the newest event is a wait
};

/// Makes a differential-drive robot with a bumper, a range finder and perhaps a camera, at rest at the start.
SimulatedRobot simulated_explorer(const World& world, const Pose2& start, const RobotModel& robot,
                                  const ExplorerSimParams& params, std::uint64_t seed,
                                  std::optional<SimulatedTagCamera> camera = {});

}  // namespace outrider
