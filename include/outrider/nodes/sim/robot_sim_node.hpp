// RobotSimNode: what all simulated robots behind topics have in common.
//
//   cmd_vel  geometry_msgs/TwistStamped, or Twist   ->   odom     nav_msgs/Odometry
//                                                        /tf, /tf_static, /clock
//                                                        sim/pose    geometry_msgs/PoseStamped: the true one
//                                                        sim/status  what it does, and when no command comes
//
// The robot stops if no command has come for `patience`, as the bases of real robots do. Faults: what it
// measures and the commands to it are lost or late; /clock, /tf_static and what tells the truth are not. Its
// time begins with the first tick, and passes in steps of 0.05 s. A robot is a class that turns commands into
// those of its body, and sends what its devices measure. Same options, messages and times: same outputs.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "outrider/log/encoding/codecs.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/nodes/messages/message_faults.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

struct RobotSimOptions {
  std::uint64_t seed = 1;
  bool plain_twist = false;  ///< commands are Twist, not TwistStamped
  double patience_s = 0.5;   ///< time without a command after which the robot stops
  MessageFaults faults;
};

class RobotSimNode : public Node {
 public:
  [[nodiscard]] const SimulatedRobot& robot() const { return robot_; }

 protected:
  static constexpr double step_s = 0.05;
  static constexpr const char* base_frame = "base_link";

  /// The pose and the motion of the robot according to its own measurements.
  struct Whereabouts {
    Pose2 odometry;
    Twist2 twist;                     ///< by its odometry
    std::optional<Pose2> map_T_odom;  ///< if it tells
  };

  RobotSimNode(SimulatedRobot robot, const RobotSimOptions& options);

  /// Returns the command to the body that drives it by `twist` for a step.
  virtual Command drive(const Twist2& twist, double until_s) = 0;
  virtual Whereabouts whereabouts(const Observation& seen) = 0;
  /// Returns where a device is on the robot.
  [[nodiscard]] virtual geometry_msgs::TransformStamped mount(double time_s) const = 0;
  /// Sends what the devices have measured.
  virtual void send_measured(const Observation& seen, double time_s) = 0;
  /// Says what it does.
  virtual void report() { set_status_of_commands(NodeLevel::info, {}); }

  /// Sends with the faults.
  template <class Message>
  void send_late(std::size_t output, const Message& message) {
    sensors_.push(now_s(), {output, encode(MessageEncoding::cdr, message)});
  }
  /// Returns the time of the node at a time of the simulation.
  [[nodiscard]] double node_s(double simulated_s) const { return *began_s_ + simulated_s; }
  /// Sets the status: what is told before, and whether commands come.
  void set_status_of_commands(NodeLevel level, const std::string& before);

 private:
  Status take_command(const geometry_msgs::Twist& twist);
  void act() override;
  void step();
  void measure();

  RobotSimOptions options_;
  SimulatedRobot robot_;
  FaultyLink<NodeOutput> sensors_;
  FaultyLink<Twist2> commands_;
  std::optional<double> began_s_;  ///< time of the node at which the simulation began
  Twist2 wanted_;
  double command_s_ = -std::numeric_limits<double>::infinity();
  bool mounted_ = false;
  std::size_t odometry_output_, transform_output_, mount_output_, clock_output_, pose_output_;
};

}  // namespace outrider
