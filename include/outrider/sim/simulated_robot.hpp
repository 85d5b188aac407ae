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
#include <variant>

#include "outrider/robot/robot.hpp"
#include "outrider/sim/piece_body.hpp"
#include "outrider/sim/simulated_laser.hpp"
#include "outrider/sim/simulated_tag_camera.hpp"
#include "outrider/sim/twist_body.hpp"
#include "outrider/sim/wheel_body.hpp"

namespace outrider {

using SimulatedBody = std::variant<TwistBody, WheelBody, PieceBody>;

struct SimulatedDevices {
  std::optional<SimulatedLaser> laser = {};
  std::optional<SimulatedTagCamera> camera = {};
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

 private:
  void run_until(double time_s);

  SimulatedBody body_;
  SimulatedDevices devices_;
  Kidnapping kidnapping_;
  bool kidnapped_ = false;
};

/// A robot on two wheels with a bumper and a range finder, at rest at the start.
SimulatedRobot simulated_explorer(const World& world, const Pose2& start, const RobotModel& robot,
                                  const ExplorerSimParams& params, std::uint64_t seed);

}  // namespace outrider
