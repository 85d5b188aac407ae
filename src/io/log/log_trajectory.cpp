#include "outrider/io/log/log_trajectory.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>

#include "outrider/io/log/log_file.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"
#include "outrider/log/find_topic.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

using geometry_msgs::PoseStamped;
using geometry_msgs::PoseWithCovarianceStamped;

/// Adds the poses of a message that was recorded at a time.
using PoseReader = std::function<Status(const LogMessage&, Trajectory&)>;

void add_poses(const PoseStamped& message, std::int64_t recorded_ns, Trajectory& trajectory) {
  trajectory.push_back({nanoseconds_of(message.header, recorded_ns), message.pose});
}
template <class Message>
void add_poses(const Message& message, std::int64_t recorded_ns, Trajectory& trajectory) {
  trajectory.push_back({nanoseconds_of(message.header, recorded_ns), message.pose.pose});
}
void add_poses(const nav_msgs::Path& path, std::int64_t recorded_ns, Trajectory& trajectory) {
  trajectory.clear();
  for (const PoseStamped& pose : path.poses)
    add_poses(pose, nanoseconds_of(path.header, recorded_ns), trajectory);
}

template <class Message>
Outcome<PoseReader> reader_for(const Channel& channel) {
  auto decoder = ChannelDecoder<Message>::of(channel);
  if (!decoder) return pass_on(decoder);
  return PoseReader(
      [decoder = std::move(*decoder)](const LogMessage& encoded, Trajectory& trajectory) -> Status {
        Message message;
        if (auto ok = decoder.decode(encoded.data, message); !ok) return ok;
        add_poses(message, encoded.time_ns, trajectory);
        return {};
      });
}

Outcome<PoseReader> reader_of(const Channel& channel) {
  const std::string type = ros2_type_name(channel.type);
  if (type == PoseStamped::type) return reader_for<PoseStamped>(channel);
  if (type == nav_msgs::Odometry::type) return reader_for<nav_msgs::Odometry>(channel);
  if (type == nav_msgs::Path::type) return reader_for<nav_msgs::Path>(channel);
  return reader_for<PoseWithCovarianceStamped>(channel);
}

Status check_times(const Trajectory& trajectory, const std::string& topic) {
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i].time_ns >= trajectory[i - 1].time_ns) continue;
    return bad_input(
        fmt::format("the time of its poses goes back from {:.3f} s to {:.3f} s; cut the log there",
                    trajectory[i - 1].time_s(), trajectory[i].time_s()),
        topic);
  }
  if (trajectory.empty()) return bad_input("it has no pose; name another topic", topic);
  if (trajectory.front().time_ns >= 0) return {};
  return bad_input(
      fmt::format("its first pose has the time {:.3f} s; times count from 1970", trajectory.front().time_s()),
      topic);
}

}  // namespace

Outcome<Trajectory> trajectory_from_log(const std::string& path, const std::string& topic) {
  constexpr std::size_t most_poses = 5'000'000;
  auto contents = open_log_file(path);
  if (!contents) return pass_on(contents);
  const TopicWish wish{
      {PoseStamped::type, PoseWithCovarianceStamped::type, nav_msgs::Odometry::type, nav_msgs::Path::type},
      topic,
      "--topic"};
  const std::vector<Channel> channels = (*contents)->channels();
  contents->reset();
  const auto found = find_topic(channels, wish);
  if (!found) return pass_on(found);
  std::map<std::size_t, PoseReader> readers;
  for (const std::size_t index : *found) {
    auto reader = reader_of(channels[index]);
    if (!reader) return pass_on(reader);
    readers.emplace(index, std::move(*reader));
  }
  const std::string& name = channels[found->front()].topic;
  auto log = open_log_file(path, {.topics = {name}});
  if (!log) return pass_on(log);
  Trajectory trajectory;
  for (;;) {
    auto message = (*log)->next();
    if (!message) return pass_on(message);
    if (!*message) break;
    if (auto ok = readers.at((*message)->channel)(**message, trajectory); !ok) return pass_on(ok);
    if (trajectory.size() > most_poses) {
      return bad_input(fmt::format("it has more than {} poses, the most that are read", most_poses), name);
    }
  }
  if (auto ok = check_times(trajectory, name); !ok) return pass_on(ok);
  return trajectory;
}

Status write_trajectory(const Trajectory& trajectory, McapWriter& log, const std::string& topic) {
  const std::size_t channel = log.add_channel(channel_of<PoseStamped>(topic));
  for (const auto& [time_ns, pose] : trajectory) {
    PoseStamped message;
    message.header.stamp = {static_cast<std::int32_t>(time_ns / 1'000'000'000),
                            static_cast<std::uint32_t>(time_ns % 1'000'000'000)};
    message.header.frame_id = "map";
    message.pose = pose;
    if (auto ok = log.write(channel, time_ns, encode(MessageEncoding::cdr, message)); !ok) return ok;
  }
  return {};
}

}  // namespace outrider
