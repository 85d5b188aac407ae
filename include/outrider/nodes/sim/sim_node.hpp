// SimNode: a simulated robot behind topics, in a known world: a differential drive with a range finder.
//
//   scan        sensor_msgs/LaserScan
//   sim/status  contacts, and when no command comes
//
// and what every RobotSimNode sends. The odometry begins at 0 where the robot starts; the true pose is that
// in the world. With `localised` the frame of the world is that of the map, and the transform from map to
// odometry is sent. Same world, options, messages and times: same outputs.
#pragma once

#include <cstdint>

#include "outrider/motion/robot_model.hpp"
#include "outrider/nodes/sim/robot_sim_node.hpp"

namespace outrider {

struct SimNodeOptions : RobotSimOptions {
  Pose2 start;
  RobotModel robot;
  ExplorerSimParams sim;
  bool localised = false;  ///< it sends map -> odom too, without errors
};

class SimNode final : public RobotSimNode {
 public:
  SimNode(const World& world, const SimNodeOptions& options);

 private:
  Command drive(const Twist2& twist, double until_s) override;
  Whereabouts whereabouts(const Observation& seen) override;
  [[nodiscard]] geometry_msgs::TransformStamped mount(double time_s) const override;
  void send_measured(const Observation& seen, double time_s) override;
  void report() override;

  bool localised_;
  std::int64_t contacts_ = 0;
  std::size_t scan_output_;
};

}  // namespace outrider
