// Trajectories as the benchmarks of odometry and SLAM exchange them.
//
// TUM (RGB-D SLAM dataset of the Technical University of Munich): "time x y z qx qy qz qw" in a line, s and
// m; '#' starts a comment. KITTI (odometry benchmark): the upper three rows of the 4 x 4 pose matrix, 12
// numbers in a line, and no time. Numbers are written in the shortest form that reads back as the same
// number, times to the nanosecond.
//
// Faults of reading: bad_input with file:line. Bounds: those of read_file(), and 2,000,000 lines.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/messages/ros_messages.hpp"

namespace outrider {

using Trajectory = std::vector<Stamped<geometry_msgs::Pose>>;

Stamped<geometry_msgs::Pose> stamped_pose(double time_s, const Pose2& pose);

std::string tum_text(const Trajectory& trajectory);
/// The same of `count` poses that are made one by one; holds none of them.
std::string tum_text_of(std::size_t count,
                        const std::function<Stamped<geometry_msgs::Pose>(std::size_t)>& pose_at);
/// Times never decrease, and a quaternion has about the length 1.
Outcome<Trajectory> trajectory_from_tum(std::string_view text, const std::string& name);

/// Without the times.
std::string kitti_text(const Trajectory& trajectory);
/// Pose i gets the time i * period_s: the scans of KITTI are 0.1 s apart.
Outcome<Trajectory> trajectory_from_kitti(std::string_view text, const std::string& name,
                                          double period_s = 0.1);

/// Returns a table with one line per pose: number, x, y, heading (m, rad).
std::string track_csv(const std::vector<Pose2>& poses);

}  // namespace outrider
