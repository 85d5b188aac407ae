#include "log/robot_log.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/log/log_file.hpp"
#include "outrider/log/find_topic.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

/// Adds the decoders of channels.
Status add(const std::vector<Channel>& channels, const std::vector<std::size_t>& found, RobotData data,
           const MessageType& type, RobotChannels& all) {
  for (const std::size_t index : found) {
    auto decoder = AnyChannelDecoder::of(channels[index], type);
    if (!decoder) return pass_on(decoder);
    all.decoders.emplace(index, std::pair(data, std::move(*decoder)));
  }
  return {};
}

/// Adds the transforms under the only names that they have in ROS.
Status add_transforms(const std::vector<Channel>& channels, const std::string& name, RobotData data,
                      RobotChannels& all) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const bool named = channels[i].topic == name || channels[i].topic == "/" + name;
    if (named && ros2_type_name(channels[i].type) == tf2_msgs::TFMessage::type) found.push_back(i);
  }
  return add(channels, found, data, message_type<tf2_msgs::TFMessage>(), all);
}

Status add_odometry(const std::vector<Channel>& channels, const LaserTopicsOptions& options,
                    RobotChannels& all) {
  const auto is_odometry = [](const Channel& channel) {
    return ros2_type_name(channel.type) == nav_msgs::Odometry::type;
  };
  const auto is_moving = [](const auto& decoder) { return decoder.second.first == RobotData::moving; };
  if (options.odom.empty() && std::ranges::none_of(channels, is_odometry) &&
      std::ranges::any_of(all.decoders, is_moving))
    return {};
  const auto found = find_topic(channels, {{nav_msgs::Odometry::type}, options.odom, "--odom"});
  if (!found) return pass_on(found);
  all.odometry_topic = channels[found->front()].topic;
  return add(channels, *found, RobotData::odometry, message_type<nav_msgs::Odometry>(), all);
}

}  // namespace

Outcome<RobotChannels> find_robot_channels(const std::vector<Channel>& channels,
                                           const LaserTopicsOptions& options) {
  const auto found = find_topic(channels, {{sensor_msgs::LaserScan::type}, options.scan, "--scan"});
  if (!found) return pass_on(found);
  RobotChannels all{channels[found->front()].topic, {}};
  auto ok = add(channels, *found, RobotData::scan, message_type<sensor_msgs::LaserScan>(), all);
  if (ok) ok = add_transforms(channels, "tf", RobotData::moving, all);
  if (ok) ok = add_transforms(channels, "tf_static", RobotData::fixed, all);
  if (ok) ok = add_odometry(channels, options, all);
  if (!ok) return pass_on(ok);
  return all;
}

Outcome<RobotLog> RobotLog::open(const std::string& path, const RobotChannels& channels, bool with_moving) {
  LogSelection selection{.topics = {channels.scan_topic, "/tf_static", "tf_static"}};
  if (!channels.odometry_topic.empty()) selection.topics.push_back(channels.odometry_topic);
  if (with_moving) selection.topics.insert(selection.topics.end(), {"/tf", "tf"});
  auto reader = open_log_file(path, selection);
  if (!reader) return pass_on(reader);
  return RobotLog(std::move(*reader), channels);
}

Outcome<std::optional<RobotMessage>> RobotLog::next() {
  for (;;) {
    auto read = reader_->next();
    if (!read) return pass_on(read);
    if (!*read) return std::optional<RobotMessage>{};
    const LogMessage& message = **read;
    const auto found = channels_->decoders.find(message.channel);
    if (found == channels_->decoders.end()) continue;
    const auto& [data, decoder] = found->second;
    if (data == RobotData::scan) {
      if (auto ok = decoder.decode(message.data, &scan_); !ok) return pass_on(ok);
      return RobotMessage{.time_ns = nanoseconds_of(scan_.header, message.time_ns), .scan = &scan_};
    }
    if (data == RobotData::odometry) {
      if (auto ok = decoder.decode(message.data, &odometry_); !ok) return pass_on(ok);
      return RobotMessage{.time_ns = nanoseconds_of(odometry_.header, message.time_ns),
                          .odometry = &odometry_};
    }
    if (auto ok = decoder.decode(message.data, &transforms_); !ok) return pass_on(ok);
    const auto kind = data == RobotData::moving ? Transforms::moving : Transforms::fixed;
    return RobotMessage{.time_ns = message.time_ns, .transforms = &transforms_, .kind = kind};
  }
}

Status OdometryTrack::add(std::int64_t time_ns, const Pose2& odom_T_robot) {
  constexpr std::int64_t window_ns = 30'000'000'000;
  constexpr std::size_t most_samples = 100'000;
  if (!finite(odom_T_robot)) return bad_input("a pose of the odometry is not finite; leave the message out");
  if (!empty() && time_ns < last_ns()) {
    return bad_input(
        fmt::format("the time of the odometry goes back from {:.3f} s to {:.3f} s; cut the log there",
                    1e-9 * static_cast<double>(last_ns()), 1e-9 * static_cast<double>(time_ns)));
  }
  if (!empty() && time_ns == last_ns()) samples_.pop_back();
  samples_.push_back({time_ns, odom_T_robot});
  while (samples_.size() > most_samples ||
         (samples_.size() > 2 && time_ns - samples_[1].time_ns > window_ns)) {
    samples_.pop_front();
  }
  return {};
}

Pose2 OdometryTrack::at(std::int64_t time_ns) const {
  const auto after = std::ranges::lower_bound(samples_, time_ns, {}, &Sample::time_ns);
  if (after == samples_.end()) return samples_.back().pose;
  if (after->time_ns == time_ns || after == samples_.begin()) return after->pose;
  const Sample& before = *std::prev(after);
  const double share =
      static_cast<double>(time_ns - before.time_ns) / static_cast<double>(after->time_ns - before.time_ns);
  const double turn_rad = wrap_angle(after->pose.heading_rad - before.pose.heading_rad);
  return {before.pose.position + share * (after->pose.position - before.pose.position),
          before.pose.heading_rad + share * turn_rad};
}

}  // namespace outrider
