// RobotLog: the scans, the odometry and the transforms of a log, decoded, in the order of the log.
// OdometryTrack: the pose by odometry at any time.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/io/log/laser_topics.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/transform_buffer.hpp"

namespace outrider {

/// The contents of the messages that mapping uses.
enum class RobotData { scan, odometry, moving, fixed };

/// The channels of a log that mapping uses.
struct RobotChannels {
  std::string scan_topic;
  std::string odometry_topic;                                                    ///< empty: it is in /tf
  std::map<std::size_t, std::pair<RobotData, AnyChannelDecoder>> decoders = {};  ///< by index in the log
};

/// Chooses the channels. Fault: bad_input with the option that names a topic, or with the topic whose schema
/// is wrong.
Outcome<RobotChannels> find_robot_channels(const std::vector<Channel>& channels,
                                           const LaserTopicsOptions& options);

/// A message; one of the pointers is not null. It is valid until the next one.
struct RobotMessage {
  std::int64_t time_ns = 0;  ///< the stamp of a scan or of odometry; when it was recorded if that is 0
  const sensor_msgs::LaserScan* scan = nullptr;
  const nav_msgs::Odometry* odometry = nullptr;
  const tf2_msgs::TFMessage* transforms = nullptr;
  Transforms kind = Transforms::moving;
};

class RobotLog {
 public:
  /// Opens the log for the channels; for its moving transforms only if `with_moving` is true.
  static Outcome<RobotLog> open(const std::string& path, const RobotChannels& channels, bool with_moving);

  /// Returns the next message; nothing at the end. Fault: bad_input.
  Outcome<std::optional<RobotMessage>> next();
  [[nodiscard]] const LogReader& reader() const { return *reader_; }

 private:
  RobotLog(std::unique_ptr<LogReader> reader, const RobotChannels& channels)
      : reader_(std::move(reader)), channels_(&channels) {}

  std::unique_ptr<LogReader> reader_;
  const RobotChannels* channels_;
  sensor_msgs::LaserScan scan_;
  nav_msgs::Odometry odometry_;
  tf2_msgs::TFMessage transforms_;
};

/// The latest poses of a robot by odometry, asked for at times between them.
class OdometryTrack {
 public:
  /// Adds a pose; one of the same time replaces the one before. Poses more than 30 s older are forgotten.
  /// Fault: bad_input if it is not finite, or the time goes back.
  Status add(std::int64_t time_ns, const Pose2& odom_T_robot);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] std::int64_t first_ns() const { return samples_.front().time_ns; }
  [[nodiscard]] std::int64_t last_ns() const { return samples_.back().time_ns; }

  /// Returns the pose: exactly one that was added, or between two linear in position and heading; outside of
  /// all the nearest. Expects that it is not empty.
  [[nodiscard]] Pose2 at(std::int64_t time_ns) const;

 private:
  struct Sample {
    std::int64_t time_ns = 0;
    Pose2 pose;
  };
  std::deque<Sample> samples_;
};

}  // namespace outrider
