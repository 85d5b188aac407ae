// Functions that append what most jobs log, from values of the library.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/messages/ros_messages.hpp"

namespace outrider {

/// Appends the true pose of the robot, as a pose and as the transform from "map" to "base_link".
void log_pose(Log& log, double time_s, const Pose2& pose);

/// Appends the believed pose. `covariance` is that of x, y and heading: m^2, m rad, rad^2. If an observation
/// corrected the belief since the one before, the pose is appended to /corrections, too.
void log_belief(Log& log, double time_s, const Pose2& pose, const Eigen::Matrix3d& covariance,
                bool corrected);

/// Appends the path that the robot drives from now on; no points: none.
void log_plan(Log& log, double time_s, const std::vector<Vec2>& points);

/// Appends the direction of the barrel: yaw counter-clockwise from where the robot looks, and pitch up from
/// the horizon.
void log_gun(Log& log, double time_s, double yaw_rad, double pitch_rad);

/// Appends something that happened: its kind, such as "shot", and one sentence.
void log_event(Log& log, double time_s, std::string kind, std::string sentence);

/// Returns the events of that kind; of all kinds if it is empty.
std::vector<Stamped<rcl_interfaces::Log>> events_of(const Log& log, std::string_view kind = {});

/// Returns the true poses of the robot so far.
std::vector<Pose2> poses_of(const Log& log);

/// Appends the outline of the robot, in its own frame, at time 0. A robot without one is a disk.
void log_footprint(Log& log, const std::vector<Vec2>& outline);

}  // namespace outrider
