#include "outrider/nodes/sim/robot_sim_node.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr const char* odom_frame = "odom";

}  // namespace

RobotSimNode::RobotSimNode(SimulatedRobot robot, const RobotSimOptions& options)
    : Node("sim", step_s),
      options_(options),
      robot_(std::move(robot)),
      sensors_(options.faults, Rng(options.seed).child("lost measurements")),
      commands_(options.faults, Rng(options.seed).child("lost commands")) {
  if (options_.plain_twist) {
    listen<geometry_msgs::Twist>("cmd_vel", Delivery::reliable,
                                 [this](const auto& twist) { return take_command(twist); });
  } else {
    listen<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable,
                                        [this](const auto& stamped) { return take_command(stamped.twist); });
  }
  odometry_output_ = add_output<nav_msgs::Odometry>("odom", Delivery::reliable);
  transform_output_ = add_output<tf2_msgs::TFMessage>("/tf", Delivery::reliable);
  mount_output_ = add_output<tf2_msgs::TFMessage>("/tf_static", Delivery::latched);
  clock_output_ = add_output<rosgraph_msgs::Clock>("/clock", Delivery::reliable);
  pose_output_ = add_output<geometry_msgs::PoseStamped>("~/pose", Delivery::reliable);
}

Status RobotSimNode::take_command(const geometry_msgs::Twist& twist) {
  const Twist2 command{twist.linear.x, twist.linear.y, twist.angular.z};
  if (!std::isfinite(command.ahead_mps) || !std::isfinite(command.left_mps) ||
      !std::isfinite(command.turn_radps))
    return bad_input(fmt::format("the command {:g}, {:g} m/s, {:g} rad/s is not finite", command.ahead_mps,
                                 command.left_mps, command.turn_radps));
  commands_.push(now_s(), command);
  return {};
}

void RobotSimNode::measure() {
  const Observation seen = robot_.sense();
  const double time_s = node_s(seen.time_s);
  const Whereabouts at = whereabouts(seen);
  nav_msgs::Odometry odometry;
  odometry.header = header_of(time_s, odom_frame);
  odometry.child_frame_id = base_frame;
  odometry.pose.pose = pose_of(at.odometry);
  odometry.twist.twist.linear.x = at.twist.ahead_mps;
  odometry.twist.twist.linear.y = at.twist.left_mps;
  odometry.twist.twist.angular.z = at.twist.turn_radps;
  send_late(odometry_output_, odometry);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(time_s, at.odometry, odom_frame, base_frame));
  if (at.map_T_odom) transforms.transforms.push_back(transform_of(time_s, *at.map_T_odom, "map", odom_frame));
  send_late(transform_output_, transforms);
  send_measured(seen, time_s);
  send(pose_output_, stamped(time_s, robot_.pose(), "world"));
  send(clock_output_, rosgraph_msgs::Clock{stamp_of(time_s)});
}

void RobotSimNode::step() {
  while (const auto command = commands_.take(now_s())) {
    wanted_ = *command;
    command_s_ = now_s();
  }
  if (now_s() - command_s_ > options_.patience_s) wanted_ = {};
  robot_.act(drive(wanted_, robot_.time_s() + step_s));
  measure();
}

void RobotSimNode::set_status_of_commands(NodeLevel level, const std::string& before) {
  const bool commanded = now_s() - command_s_ <= options_.patience_s;
  set_status(level, commanded ? "commanded" : "idle",
             before + (commanded ? std::string("commands come")
                                 : fmt::format("no command has come for {:g} s, so it stands",
                                               options_.patience_s)));
}

void RobotSimNode::act() {
  if (!began_s_) {
    began_s_ = now_s();
    measure();
  }
  if (!std::exchange(mounted_, true)) send(mount_output_, tf2_msgs::TFMessage{{mount(*began_s_)}});
  while (node_s(robot_.time_s()) + step_s <= now_s() + 1e-9) step();
  while (auto measured = sensors_.take(now_s())) send_bytes(std::move(*measured));
  report();
}

}  // namespace outrider
