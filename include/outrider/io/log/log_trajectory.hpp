// Trajectories from logs, and as logs.
#pragma once

#include <string>

#include "outrider/io/log/trajectory.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"

namespace outrider {

/// Reads the poses of a topic: of nav_msgs/Odometry, geometry_msgs/PoseStamped and PoseWithCovarianceStamped
/// one a message, of nav_msgs/Path those of the newest message. Empty: the only topic of these types. A pose
/// has the time of the stamp in its header, or that at which it was recorded if that is 0. Faults: bad_input
/// with the topic, or with "--topic" if there are none or several; for times that go back, and for more than
/// 5,000,000 poses.
Outcome<Trajectory> trajectory_from_log(const std::string& path, const std::string& topic = {});

/// Writes the poses as geometry_msgs/PoseStamped in the frame "map". Fault: that of the writer.
Status write_trajectory(const Trajectory& trajectory, McapWriter& log, const std::string& topic = "/pose");

}  // namespace outrider
