#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "team/team_report.hpp"

namespace outrider {
namespace {

/// A message that waits for its turn.
struct TeamMessage {
  std::int64_t time_ns = 0;
  std::function<void(Log&)> append;
};

/// Adds the messages of one topic of a robot, which get another one.
template <class Message>
void collect(std::vector<TeamMessage>& all, const Log& from, std::string_view topic, const std::string& to) {
  for (const Stamped<Message>& one : from.messages<Message>(topic))
    all.push_back({one.time_ns, [&one, to](Log& log) { log.append(to, one.time_s(), one.message); }});
}

/// Adds what became of the targets of a robot. Only the first one tells how all of them were at first.
void collect_targets(std::vector<TeamMessage>& all, const Log& from, bool first) {
  std::set<std::string_view> told;
  for (const auto& one : from.messages<outrider_msgs::Target>(topic::targets)) {
    const bool at_first = told.insert(one.message.name).second;
    if (at_first && !first) continue;
    all.push_back({one.time_ns, [&one](Log& log) { log.append(topic::targets, one.time_s(), one.message); }});
  }
  if (first)
    collect<outrider_msgs::TargetPosition>(all, from, topic::target_positions,
                                           std::string(topic::target_positions));
}

void collect_events(std::vector<TeamMessage>& all, const Log& from, const std::string& who) {
  for (const auto& one : from.messages<rcl_interfaces::Log>(topic::events)) {
    all.push_back({one.time_ns, [&one, who](Log& log) {
                     rcl_interfaces::Log event = one.message;
                     event.msg = who + event.msg;
                     log.append(topic::events, one.time_s(), std::move(event));
                   }});
  }
}

}  // namespace

void append_team(Log& log, const TeamRun& team) {
  std::vector<TeamMessage> all;
  for (std::size_t r = 0; r < team.robots.size(); ++r) {
    const Log& from = team.robots[r].log;
    const auto named = [&](std::string_view topic) {
      return r == 0 ? std::string(topic) : fmt::format("/robot_{}{}", r + 1, topic);
    };
    collect<geometry_msgs::PoseStamped>(all, from, topic::pose, named(topic::pose));
    if (r == 0) collect<tf2_msgs::TFMessage>(all, from, topic::transforms, std::string(topic::transforms));
    collect<sensor_msgs::JointState>(all, from, topic::joints, named(topic::joints));
    collect<nav_msgs::Path>(all, from, topic::plan, named(topic::plan));
    collect<outrider_msgs::Shot>(all, from, topic::shots, std::string(topic::shots));
    collect_targets(all, team.robots[r].targets, r == 0);
    collect_events(all, from, fmt::format("robot {}: ", r + 1));
  }
  std::ranges::stable_sort(all, {}, &TeamMessage::time_ns);
  for (const TeamMessage& message : all) message.append(log);
}

}  // namespace outrider
