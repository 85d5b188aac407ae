// Looks on while a run logs, with nothing but the bytes of its messages: what it has seen must make the
// report.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "outrider/log/gun_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider::testing {

class Curious final : public LogSink {
 public:
  void add_channel(const Channel& channel) override { channels_.push_back(channel); }

  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    take(channels_.at(channel), time_ns, data);
  }

  void expect_to_have_seen(const PageReport& report) {
    const PageReport told = page_report({}, log_);
    EXPECT_EQ(told.world_name, report.world_name);
    ASSERT_EQ(told.track.size(), report.track.size());
    for (std::size_t i = 0; i < report.track.size(); ++i) {
      EXPECT_EQ(told.track[i].time_s, report.track[i].time_s);
      EXPECT_EQ(told.track[i].pose, report.track[i].pose);
    }
    ASSERT_EQ(told.shots.size(), report.shots.size());
    for (std::size_t i = 0; i < report.shots.size(); ++i) {
      EXPECT_EQ(told.shots[i].time_s, report.shots[i].time_s);
      EXPECT_EQ(told.shots[i].target, report.shots[i].target);
    }
    EXPECT_LE(told.targets.size(), report.targets.size());
    for (const ReportTarget& target : told.targets) {
      const auto has = [&](const ReportTarget& one) {
        return one.name == target.name && one.status == target.status && one.shots == target.shots;
      };
      EXPECT_TRUE(std::ranges::any_of(report.targets, has)) << target.name << " is " << target.status;
    }
    EXPECT_EQ(told.explore.has_value(), report.explore.has_value());
    EXPECT_EQ(told.drive.has_value(), report.drive.has_value());
    if (told.explore && report.explore) {
      EXPECT_EQ(told.explore->beliefs.size(), report.explore->beliefs.size());
      EXPECT_EQ(told.explore->map.state_runs, report.explore->map.state_runs);
    }
    if (told.drive && report.drive) {
      EXPECT_EQ(told.drive->beliefs.size(), report.drive->beliefs.size());
    }
  }

  /// In the order in which they were told.
  [[nodiscard]] std::vector<ReportEvent> events() const { return page_report({}, log_).events; }

 private:
  template <class Message>
  bool take_as(const Channel& channel, std::int64_t time_ns, std::string_view data) {
    if (channel.type != Message::type) return false;
    auto message = decode<Message>(MessageEncoding::cdr, data);
    EXPECT_TRUE(message) << channel.topic;
    if (message) log_.append(channel.topic, seconds(time_ns), std::move(*message));
    return true;
  }
  template <class... Messages>
  bool take_any(const Channel& channel, std::int64_t time_ns, std::string_view data) {
    return (take_as<Messages>(channel, time_ns, data) || ...);
  }

  void take(const Channel& channel, std::int64_t time_ns, std::string_view data) {
    namespace own = outrider_msgs;
    const bool known =
        take_any<geometry_msgs::PoseStamped, geometry_msgs::PoseWithCovarianceStamped, tf2_msgs::TFMessage,
                 nav_msgs::Odometry, nav_msgs::Path, nav_msgs::OccupancyGrid, map_msgs::OccupancyGridUpdate,
                 sensor_msgs::LaserScan, sensor_msgs::JointState, sensor_msgs::CameraInfo,
                 rcl_interfaces::Log, own::RunInfo, own::Solids, own::Terrain, own::Outlines, own::Shot,
                 own::Target, own::TargetPosition, own::Supplies, own::StoreLevels, own::Tags, own::Waypoints,
                 own::Decision, own::Refusal>(channel, time_ns, data);
    EXPECT_TRUE(known) << channel.topic << " has the type " << channel.type;
  }

  std::vector<Channel> channels_;
  outrider::Log log_;  ///< as it was sent
};

}  // namespace outrider::testing
