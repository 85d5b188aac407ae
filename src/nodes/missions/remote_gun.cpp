#include "outrider/nodes/missions/remote_gun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr double most_rad = 1e3;

/// Returns the position of a joint; nothing if it is not there.
std::optional<double> position_of(const sensor_msgs::JointState& message, std::string_view joint) {
  const auto found = std::ranges::find(message.name, joint);
  if (found == message.name.end()) return std::nullopt;
  return message.position[static_cast<std::size_t>(found - message.name.begin())];
}

}  // namespace

RemoteGun::RemoteGun(const std::vector<Target>& targets)
    : fired_at_(targets.size(), false), hit_(targets.size(), false) {
  for (std::size_t i = 0; i < targets.size(); ++i) by_name_.emplace(targets[i].name, i);
}

Status RemoteGun::take(const sensor_msgs::JointState& message, double now_s) {
  auto joints = joints_of(message);
  if (!joints) return pass_on(joints);
  if (!*joints) return {};
  const std::optional<double> before_s = stamps_.newest_s();
  const auto time_s = stamps_.take(message.header.stamp);
  if (!time_s) return pass_on(time_s);
  joints_ = *joints;
  if (before_s != *time_s) came_s_ = now_s;  // the same once more is not new
  return {};
}

Status RemoteGun::take(const std_msgs::String& hit) {
  const auto found = by_name_.find(hit.data);
  if (found == by_name_.end())
    return bad_input(fmt::format("no target has the name '{}'", excerpt(hit.data)));
  if (!fired_at_[found->second]) {
    return bad_input(
        fmt::format("'{}' is told to be hit, and the gun was not fired at it", excerpt(hit.data)));
  }
  hit_[found->second] = true;
  return {};
}

sensor_msgs::JointState joints_message(const GunState& joints, double time_s) {
  sensor_msgs::JointState message;
  message.header = header_of(time_s, "");
  message.name = {"yaw", "pitch"};
  message.position = {joints.yaw_rad, joints.pitch_rad};
  return message;
}

Outcome<std::optional<GunState>> joints_of(const sensor_msgs::JointState& message) {
  if (message.name.size() != message.position.size()) {
    return bad_input(fmt::format("it has {} names and {} positions; it has to have as many of both",
                                 message.name.size(), message.position.size()));
  }
  const auto yaw = position_of(message, "yaw"), pitch = position_of(message, "pitch");
  if (!yaw || !pitch) return std::nullopt;
  if (!(std::abs(*yaw) <= most_rad) || !(std::abs(*pitch) <= most_rad)) {
    return bad_input(
        fmt::format("its joints are at {:g} and {:g} rad; up to {:g} are taken", *yaw, *pitch, most_rad));
  }
  return std::optional(GunState{*yaw, *pitch});
}

}  // namespace outrider
