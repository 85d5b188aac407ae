#include "outrider/nodes/sim_node.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/job/sensor_log.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/ros_sensor_messages.hpp"

namespace outrider {
namespace {

constexpr double step_s = 0.05;
constexpr const char* odom_frame = "odom";
constexpr const char* base_frame = "base_link";
constexpr const char* laser_frame = "laser";

}  // namespace

SimNode::SimNode(const World& world, const SimNodeOptions& options)
    : Node("sim", step_s),
      options_(options),
      robot_(simulated_explorer(world, options.start, options.robot, options.sim, options.seed)),
      sensors_(options.faults, Rng(options.seed).child("lost measurements")),
      commands_(options.faults, Rng(options.seed).child("lost commands")) {
  if (options_.plain_twist) {
    listen<geometry_msgs::Twist>("cmd_vel", Delivery::reliable,
                                 [this](const auto& twist) { return take_command(twist); });
  } else {
    listen<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable,
                                        [this](const auto& stamped) { return take_command(stamped.twist); });
  }
  scan_output_ = add_output<sensor_msgs::LaserScan>("scan", Delivery::sensor);
  odometry_output_ = add_output<nav_msgs::Odometry>("odom", Delivery::reliable);
  transform_output_ = add_output<tf2_msgs::TFMessage>("/tf", Delivery::reliable);
  mount_output_ = add_output<tf2_msgs::TFMessage>("/tf_static", Delivery::latched);
  clock_output_ = add_output<rosgraph_msgs::Clock>("/clock", Delivery::reliable);
  pose_output_ = add_output<geometry_msgs::PoseStamped>("~/pose", Delivery::reliable);
}

Status SimNode::take_command(const geometry_msgs::Twist& twist) {
  if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z))
    return bad_input(
        fmt::format("the command {:g} m/s, {:g} rad/s is not finite", twist.linear.x, twist.angular.z));
  commands_.push(now_s(), Twist2{twist.linear.x, 0.0, twist.angular.z});
  return {};
}

template <class Message>
void SimNode::send_late(std::size_t output, const Message& message) {
  sensors_.push(now_s(), {output, encode(MessageEncoding::cdr, message)});
}

void SimNode::measure() {
  const Observation seen = robot_.sense();
  const double time_s = *began_s_ + seen.time_s;
  const Twist2 twist = robot_.body<TwistBody>().twist();
  nav_msgs::Odometry odometry;
  odometry.header = header_of(time_s, odom_frame);
  odometry.child_frame_id = base_frame;
  odometry.pose.pose = pose_of(seen.odometry);
  odometry.twist.twist.linear.x = twist.ahead_mps;
  odometry.twist.twist.angular.z = twist.turn_radps;
  send_late(odometry_output_, odometry);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(time_s, seen.odometry, odom_frame, base_frame));
  if (options_.localised) {
    const Pose2 map_T_odom = wrap_heading(compose(robot_.pose(), inverse(seen.odometry)));
    transforms.transforms.push_back(transform_of(time_s, map_T_odom, "map", odom_frame));
  }
  send_late(transform_output_, transforms);
  if (seen.scan) send_late(scan_output_, scan_message(*seen.scan, time_s));
  send(pose_output_, stamped(time_s, robot_.pose(), "world"));
  send(clock_output_, rosgraph_msgs::Clock{stamp_of(time_s)});
}

void SimNode::step() {
  while (const auto command = commands_.take(now_s())) {
    wanted_ = *command;
    command_s_ = now_s();
  }
  if (now_s() - command_s_ > options_.patience_s) wanted_ = {};
  robot_.act(DriveTwist{wanted_, robot_.time_s() + step_s});
  measure();
}

void SimNode::report() {
  const std::int64_t contacts = robot_.body<TwistBody>().contacts();
  if (contacts > contacts_) {
    contacts_ = contacts;
    tell(NodeLevel::warning, fmt::format("the robot touches something at {:.2f}, {:.2f}",
                                         robot_.pose().position.x, robot_.pose().position.y));
  }
  const bool commanded = now_s() - command_s_ <= options_.patience_s;
  set_status(contacts_ > 0 ? NodeLevel::error : NodeLevel::info, commanded ? "commanded" : "idle",
             fmt::format("{} contacts; {}", contacts_,
                         commanded ? std::string("commands come")
                                   : fmt::format("no command has come for {:g} s, so it stands",
                                                 options_.patience_s)));
}

void SimNode::act() {
  if (!began_s_) {
    began_s_ = now_s();
    measure();
  }
  if (!std::exchange(mounted_, true)) {
    tf2_msgs::TFMessage mount;
    mount.transforms.push_back(
        transform_of(*began_s_, options_.sim.laser.robot_T_laser, base_frame, laser_frame));
    mount.transforms.back().transform.translation.z = options_.sim.laser.height_m;
    send(mount_output_, mount);
  }
  while (*began_s_ + robot_.time_s() + step_s <= now_s() + 1e-9) step();
  while (auto measured = sensors_.take(now_s())) send_bytes(std::move(*measured));
  report();
}

}  // namespace outrider
