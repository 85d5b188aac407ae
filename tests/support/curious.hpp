// Looks on while a run logs, with nothing but the bytes of its messages. It puts together what is new at each
// look: that must make the report.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "outrider/log/gun_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/report/growth.hpp"

namespace outrider::testing {

class Curious final : public LogSink {
 public:
  void add_channel(const Channel& channel) override { channels_.push_back(channel); }

  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    take(channels_.at(channel), time_ns, data);
    if (++messages_ < next_look_) return;
    next_look_ = messages_ + messages_ / 4 + 1;  // a look takes as long as the log is
    look();
  }

  void expect_to_have_seen(const PageReport& report) {
    look();
    EXPECT_EQ(world_name_, report.world_name);
    ASSERT_EQ(told_.track.size(), report.track.size());
    for (std::size_t i = 0; i < report.track.size(); ++i) {
      EXPECT_EQ(told_.track[i].time_s, report.track[i].time_s);
      EXPECT_EQ(told_.track[i].pose, report.track[i].pose);
    }
    ASSERT_EQ(told_.shots.size(), report.shots.size());
    for (std::size_t i = 0; i < report.shots.size(); ++i) {
      EXPECT_EQ(told_.shots[i].time_s, report.shots[i].time_s);
      EXPECT_EQ(told_.shots[i].target, report.shots[i].target);
    }
    EXPECT_LE(told_.targets.size(), report.targets.size());
    for (const ReportTarget& target : told_.targets) {
      const auto has = [&](const ReportTarget& one) {
        return one.name == target.name && one.status == target.status && one.shots == target.shots;
      };
      EXPECT_TRUE(std::ranges::any_of(report.targets, has)) << target.name << " is " << target.status;
    }
    EXPECT_EQ(beliefs_.size(), (report.explore ? report.explore->beliefs.size() : 0) +
                                   (report.drive ? report.drive->beliefs.size() : 0));
    EXPECT_TRUE(!report.explore || map_.state_runs == report.explore->map.state_runs);
  }

  /// In the order in which they were told.
  [[nodiscard]] const std::vector<ReportEvent>& events() const { return told_.events; }

 private:
  template <class T>
  static void append_all(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }

  void look() {
    const PageReport news = growth_.delta(page_report({}, log_));
    EXPECT_EQ(news.status, "running");
    EXPECT_TRUE(!news.job.empty() || news.solids.empty()) << "what stands still is told once";
    if (!news.job.empty()) world_name_ = news.world_name;
    append_all(told_.track, news.track);
    append_all(told_.shots, news.shots);
    append_all(told_.events, news.events);
    if (!news.targets.empty()) told_.targets = news.targets;
    if (news.explore) append_all(beliefs_, news.explore->beliefs);
    if (news.explore && news.explore->map.columns > 0) map_ = news.explore->map;
    if (news.drive) append_all(beliefs_, news.drive->beliefs);
  }

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
  std::size_t messages_ = 0;
  std::size_t next_look_ = 1;
  ReportGrowth growth_;
  std::string world_name_;
  PageReport told_;
  std::vector<ReportBelief> beliefs_;
  ReportMap map_;
};

}  // namespace outrider::testing
