// SimNode: a simulated robot behind topics, in a known world: a differential drive with a range finder.
//
//   cmd_vel  geometry_msgs/TwistStamped, or Twist   ->   scan     sensor_msgs/LaserScan
//                                                        odom     nav_msgs/Odometry
//                                                        /tf, /tf_static, /clock
//                                                        sim/pose    geometry_msgs/PoseStamped: the true one
//                                                        sim/status  contacts, and when no command comes
//
// The odometry begins at 0 where the robot starts; the true pose is that in the world. With `localised` the
// frame of the world is that of the map, and the transform from map to odometry is sent. The robot stops if
// no command has come for `patience`, as the bases of real robots do. Faults: what it measures and the
// commands to it are lost or late; /clock, /tf_static and what tells the truth are not. Its time begins with
// the first tick. Same world, options, messages and times: same outputs.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/nodes/message_faults.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

struct SimNodeOptions {
  Pose2 start;
  RobotModel robot;
  ExplorerSimParams sim;
  std::uint64_t seed = 1;
  bool plain_twist = false;  ///< commands are Twist, not TwistStamped
  bool localised = false;    ///< it sends map -> odom too, without errors
  double patience_s = 0.5;
  MessageFaults faults;
};

class SimNode final : public Node {
 public:
  SimNode(const World& world, const SimNodeOptions& options);

  [[nodiscard]] const SimulatedRobot& robot() const { return robot_; }

 private:
  Status take_command(const geometry_msgs::Twist& twist);
  void act() override;
  void step();
  void measure();
  template <class Message>
  void send_late(std::size_t output, const Message& message);
  void report();

  SimNodeOptions options_;
  SimulatedRobot robot_;
  FaultyLink<NodeOutput> sensors_;
  FaultyLink<Twist2> commands_;
  std::optional<double> began_s_;  ///< time of the node at which the simulation began
  Twist2 wanted_;
  double command_s_ = -std::numeric_limits<double>::infinity();
  bool mounted_ = false;
  std::int64_t contacts_ = 0;
  std::size_t scan_output_, odometry_output_, transform_output_, mount_output_, clock_output_, pose_output_;
};

}  // namespace outrider
