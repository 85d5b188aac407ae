// Runs of functions that log and report, and what their logs say.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/job/job.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

/// The metric of that name; NaN if the run has none.
inline double metric(const Run& run, std::string_view name) { return metric(run.report, name); }

namespace testing {

/// Calls `run` with a log that sends its messages to the sinks of the watch. It returns a report or a fault.
template <class Function>
Outcome<Run> logged_run(const RunWatch& watch, const Function& run) {
  Run done;
  for (LogSink* sink : watch.sinks) done.log.add_sink(*sink);
  Outcome<Report> report = run(done.log);
  for (LogSink* sink : watch.sinks) done.log.remove_sink(*sink);
  if (!report) return pass_on(report);
  done.report = std::move(*report);
  return done;
}

/// A true pose of the robot and its time.
struct TrackSample {
  double time_s = 0.0;
  Pose2 pose;
};

/// The true poses; between two of them the robot moves in a straight line.
inline std::vector<TrackSample> track_of(const Log& log) {
  std::vector<TrackSample> track;
  for (const auto& stamped : log.messages<geometry_msgs::PoseStamped>(topic::pose)) {
    track.push_back({stamped.time_s(), pose_of(stamped.message.pose)});
  }
  return track;
}

/// True if the stamps of poses and events never go back. The log itself puts a message that is late to the
/// time of the one before.
inline bool stamps_are_sorted(const Log& log) {
  std::vector<std::int64_t> poses_ns, events_ns;
  for (const auto& one : log.messages<geometry_msgs::PoseStamped>(topic::pose)) {
    poses_ns.push_back(nanoseconds_of(one.message.header.stamp));
  }
  for (const auto& one : events_of(log)) events_ns.push_back(nanoseconds_of(one.message.stamp));
  return std::ranges::is_sorted(poses_ns) && std::ranges::is_sorted(events_ns);
}

/// The points of the paths that were driven, of each one that has any.
inline std::vector<std::vector<Vec2>> driven_paths(const Log& log) {
  std::vector<std::vector<Vec2>> paths;
  for (const auto& stamped : log.messages<nav_msgs::Path>(topic::plan)) {
    if (stamped.message.poses.empty()) continue;
    std::vector<Vec2>& points = paths.emplace_back();
    for (const auto& one : stamped.message.poses) {
      points.push_back({one.pose.position.x, one.pose.position.y});
    }
  }
  return paths;
}

inline const std::vector<Stamped<outrider_msgs::Shot>>& shots_of(const Log& log) {
  return log.messages<outrider_msgs::Shot>(topic::shots);
}

inline Vec3 vec3_of(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }
inline Vec3 vec3_of(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

}  // namespace testing
}  // namespace outrider
