#include "outrider/log/read_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "outrider/log/gun_messages.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/ros_messages.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/log/scene_messages.hpp"

namespace outrider {
namespace {

using AppendDecoded = Status (*)(Log& log, const Channel& channel, const LogMessage& message);

/// A type of message, and the function that decodes one and appends it to a log.
struct KnownType {
  std::string_view name;
  AppendDecoded append;
};

template <class Message>
Status append_decoded(Log& log, const Channel& channel, const LogMessage& message) {
  const auto encoding = channel.encoding == "ros1" ? MessageEncoding::ros1 : MessageEncoding::cdr;
  auto decoded = decode<Message>(encoding, message.data);
  if (!decoded) return pass_on(decoded);
  log.append(channel.topic, seconds(message.time_ns), std::move(*decoded));
  return {};
}

template <class... Messages>
constexpr std::array<KnownType, sizeof...(Messages)> known_types() {
  return {{{Messages::type, &append_decoded<Messages>}...}};
}

/// The types of the channels that a run leaves.
constexpr auto run_types = known_types<
    geometry_msgs::PoseStamped, geometry_msgs::PoseWithCovarianceStamped, nav_msgs::Odometry, nav_msgs::Path,
    nav_msgs::OccupancyGrid, map_msgs::OccupancyGridUpdate, tf2_msgs::TFMessage, rcl_interfaces::Log,
    sensor_msgs::LaserScan, sensor_msgs::JointState, sensor_msgs::CameraInfo, outrider_msgs::RunInfo,
    outrider_msgs::Solids, outrider_msgs::Terrain, outrider_msgs::Outlines, outrider_msgs::Shot,
    outrider_msgs::FiringRegion, outrider_msgs::Target, outrider_msgs::TargetPosition,
    outrider_msgs::Supplies, outrider_msgs::StoreLevels, outrider_msgs::Tags, outrider_msgs::Waypoints,
    outrider_msgs::Decision, outrider_msgs::Refusal, outrider_msgs::CoverageArea, outrider_msgs::Coverage,
    outrider_msgs::CoveragePass, outrider_msgs::CostGrid, outrider_msgs::PaidCost, outrider_msgs::CostBound,
    outrider_msgs::Landmarks, outrider_msgs::Sightings, outrider_msgs::Loops>();

/// Returns how to append a message of the channel; null if a run never has its type or its encoding.
AppendDecoded append_of(const Channel& channel) {
  if (channel.encoding != "cdr" && channel.encoding != "ros1") return nullptr;
  const auto* known = std::ranges::find(run_types, channel.type, &KnownType::name);
  return known == run_types.end() ? nullptr : known->append;
}

/// Refuses a topic with channels of two types, which a run never has.
Status check_topics(const std::vector<Channel>& channels, const std::string& path) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (channels[i].topic == channels[j].topic && channels[i].type != channels[j].type) {
        return bad_input(
            fmt::format("the topic '{}' has messages of two types, {} and {}; a run never leaves that",
                        channels[i].topic, channels[j].type, channels[i].type),
            path);
      }
    }
  }
  return {};
}

}  // namespace

Outcome<StoredLog> read_log(const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{4} << 30;
  auto reader = open_log(path);
  if (!reader) return pass_on(reader);
  if (auto ok = check_topics((*reader)->channels(), path); !ok) return pass_on(ok);
  std::vector<AppendDecoded> appends;
  for (const Channel& channel : (*reader)->channels()) appends.push_back(append_of(channel));
  StoredLog stored;
  std::size_t bytes = 0;
  while (true) {
    auto message = (*reader)->next();
    if (!message) return pass_on(message);
    if (!*message) break;
    bytes += (*message)->data.size();
    if (bytes > most_bytes)
      return bad_input("its messages have more than 4 GiB; open it with the page instead", path);
    const std::size_t number = (*message)->channel;
    if (appends[number] == nullptr) continue;
    const Channel& channel = (*reader)->channels()[number];
    if (auto ok = appends[number](stored.log, channel, **message); !ok) {
      return bad_input(fmt::format("a message on '{}' at {:.3f} s: {}", channel.topic,
                                   seconds((*message)->time_ns), ok.error().sentence),
                       path);
    }
  }
  stored.cut_short = (*reader)->cut_short();
  return stored;
}

}  // namespace outrider
