#include "outrider/nodes/sim/sim_node.hpp"

#include <fmt/format.h>

#include "outrider/job/sensor_log.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {

SimNode::SimNode(const World& world, const SimNodeOptions& options)
    : RobotSimNode(simulated_explorer(world, options.start, options.robot, options.sim, options.seed),
                   options),
      localised_(options.localised) {
  scan_output_ = add_output<sensor_msgs::LaserScan>("scan", Delivery::sensor);
}

Command SimNode::drive(const Twist2& twist, double until_s) {
  return DriveTwist{{twist.ahead_mps, 0.0, twist.turn_radps}, until_s};
}

SimNode::Whereabouts SimNode::whereabouts(const Observation& seen) {
  Whereabouts at{seen.odometry, robot().body<TwistBody>().twist(), {}};
  if (localised_) at.map_T_odom = wrap_heading(compose(robot().pose(), inverse(seen.odometry)));
  return at;
}

geometry_msgs::TransformStamped SimNode::mount(double time_s) const {
  const RangeFinderModel& laser = robot().devices().laser->finder().model();
  auto transform = transform_of(time_s, laser.robot_T_laser, base_frame, "laser");
  transform.transform.translation.z = laser.height_m;
  return transform;
}

void SimNode::send_measured(const Observation& seen, double time_s) {
  if (seen.scan) send_late(scan_output_, scan_message(*seen.scan, time_s));
}

void SimNode::report() {
  const std::int64_t contacts = robot().body<TwistBody>().contacts();
  if (contacts > contacts_) {
    contacts_ = contacts;
    tell(NodeLevel::warning, fmt::format("the robot touches something at {:.2f}, {:.2f}",
                                         robot().pose().position.x, robot().pose().position.y));
  }
  set_status_of_commands(contacts_ > 0 ? NodeLevel::error : NodeLevel::info,
                         fmt::format("{} contacts; ", contacts_));
}

}  // namespace outrider
