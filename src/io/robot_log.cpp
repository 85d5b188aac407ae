#include "robot_log.hpp"

#include <algorithm>

#include "outrider/io/log_file.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/find_topic.hpp"

namespace outrider {
namespace {

template <class Message>
using Decoders = std::map<std::size_t, ChannelDecoder<Message>>;

template <class Message>
Outcome<Decoders<Message>> decoders_of(const std::vector<Channel>& channels,
                                       const std::vector<std::size_t>& found) {
  Decoders<Message> decoders;
  for (const std::size_t index : found) {
    auto decoder = ChannelDecoder<Message>::of(channels[index]);
    if (!decoder) return pass_on(decoder);
    decoders.emplace(index, std::move(*decoder));
  }
  return decoders;
}

/// Finds the transforms under the only names that they have in ROS.
Outcome<Decoders<tf2_msgs::TFMessage>> find_transforms(const std::vector<Channel>& channels,
                                                       const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const bool named = channels[i].topic == name || channels[i].topic == "/" + name;
    if (named && ros2_type_name(channels[i].type) == tf2_msgs::TFMessage::type) found.push_back(i);
  }
  return decoders_of<tf2_msgs::TFMessage>(channels, found);
}

Status find_odometry(const std::vector<Channel>& channels, const LaserTopicsOptions& options,
                     RobotChannels& all) {
  const auto is_odometry = [](const Channel& channel) {
    return ros2_type_name(channel.type) == nav_msgs::Odometry::type;
  };
  const bool in_transforms =
      options.odom.empty() && std::ranges::none_of(channels, is_odometry) && !all.moving.empty();
  if (in_transforms) return {};
  const auto found = find_topic(channels, {{nav_msgs::Odometry::type}, options.odom, "--odom"});
  if (!found) return pass_on(found);
  auto decoders = decoders_of<nav_msgs::Odometry>(channels, *found);
  if (!decoders) return pass_on(decoders);
  all.odometry_topic = channels[found->front()].topic;
  all.odometry = std::move(*decoders);
  return {};
}

}  // namespace

Outcome<RobotChannels> find_robot_channels(const std::vector<Channel>& channels,
                                           const LaserTopicsOptions& options) {
  const auto found = find_topic(channels, {{sensor_msgs::LaserScan::type}, options.scan, "--scan"});
  if (!found) return pass_on(found);
  auto scans = decoders_of<sensor_msgs::LaserScan>(channels, *found);
  if (!scans) return pass_on(scans);
  auto moving = find_transforms(channels, "tf");
  if (!moving) return pass_on(moving);
  auto fixed = find_transforms(channels, "tf_static");
  if (!fixed) return pass_on(fixed);
  RobotChannels all{
      channels[found->front()].topic, {}, std::move(*scans), {}, std::move(*moving), std::move(*fixed)};
  if (auto ok = find_odometry(channels, options, all); !ok) return pass_on(ok);
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
    const auto& [scan_topic, odometry_topic, scans, odometry, moving, fixed] = *channels_;
    if (const auto decoder = scans.find(message.channel); decoder != scans.end()) {
      if (auto ok = decoder->second.decode(message.data, scan_); !ok) return pass_on(ok);
      return RobotMessage{.time_ns = nanoseconds_of(scan_.header, message.time_ns), .scan = &scan_};
    }
    if (const auto decoder = odometry.find(message.channel); decoder != odometry.end()) {
      if (auto ok = decoder->second.decode(message.data, odometry_); !ok) return pass_on(ok);
      return RobotMessage{.time_ns = nanoseconds_of(odometry_.header, message.time_ns),
                          .odometry = &odometry_};
    }
    for (const auto* decoders : {&moving, &fixed}) {
      const auto decoder = decoders->find(message.channel);
      if (decoder == decoders->end()) continue;
      if (auto ok = decoder->second.decode(message.data, transforms_); !ok) return pass_on(ok);
      const auto kind = decoders == &moving ? Transforms::moving : Transforms::fixed;
      return RobotMessage{.time_ns = message.time_ns, .transforms = &transforms_, .kind = kind};
    }
  }
}

}  // namespace outrider
