// RemoteGun: what a mission knows of a gun on the other side of topics.
//
//   joint_states  sensor_msgs/JointState: its joints `yaw`, counter-clockwise from where the robot looks, and
//                 `pitch`, up from its floor, among others that do not matter
//   gun/hit       std_msgs/String: the name of a target that a ball hit, from whoever sees it
//
// A target counts as hit if that is told after the gun was fired at it, however late or often.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "outrider/ballistics/target.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/messages/node_messages.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

class RemoteGun {
 public:
  explicit RemoteGun(const std::vector<Target>& targets);

  /// Takes joints that came at that time of the node; a message without both has no effect. Faults: bad_input
  /// for a stamp that goes back, for lists of different lengths and numbers that are not finite.
  Status take(const sensor_msgs::JointState& message, double now_s);
  /// Faults: bad_input for a name that no target has, and for a target at which it was not fired.
  Status take(const std_msgs::String& hit);
  /// Notes that the gun is fired at a target.
  void fire_at(std::size_t target) { fired_at_.at(target) = true; }

  /// Returns the newest joints, and when they came; nothing before the first.
  [[nodiscard]] const std::optional<GunState>& joints() const { return joints_; }
  [[nodiscard]] const std::optional<double>& came_s() const { return came_s_; }
  [[nodiscard]] bool was_hit(std::size_t target) const { return hit_.at(target); }

 private:
  std::map<std::string, std::size_t, std::less<>> by_name_;
  std::vector<bool> fired_at_, hit_;  ///< by target
  NewestStamp stamps_;
  std::optional<GunState> joints_;
  std::optional<double> came_s_;
};

/// Returns joints as a message.
sensor_msgs::JointState joints_message(const GunState& joints, double time_s);
/// Returns the joints `yaw` and `pitch` of a message; nothing if it does not have both. Fault: bad_input, as
/// above.
Outcome<std::optional<GunState>> joints_of(const sensor_msgs::JointState& message);

}  // namespace outrider
