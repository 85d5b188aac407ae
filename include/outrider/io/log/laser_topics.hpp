// Laser scans and odometry from the log of a robot: MCAP, ROS 1 bag or ROS 2 db3.
//
//   auto source = open_laser_topics("run.bag", {.scan = "/scan"});
//   while (auto step = (*source)->next(); step && *step) ...
//
// Scans are sensor_msgs/LaserScan. Odometry is nav_msgs/Odometry; without such a topic, the transforms of /tf
// from the frame `odom_frame` to the robot. The pose at the time of a scan lies between the two odometry
// messages around it; a scan without odometry within 0.5 s is left out. The time of a message is the stamp in
// its header, or the time at which it was recorded if that is 0.
//
// The pose of the laser on the robot comes from /tf_static and /tf. The laser must be level, upright or
// upside down; the scans of one that is upside down, or turns clockwise, are reversed. A range below
// range_min or above range_max, or one that is no number, is no reading; an infinite one says that nothing
// was within range_max (REP 117).
//
// Memory: some chunks of the log, the odometry of 30 s, and at most 64 MiB of scans that wait for theirs.
// Faults: bad_input with the topic or the option that names one, for a log without the topics, with several
// of a type, with schemas that are not those of ROS, or with times that go back. Thread rule: one thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/log/laser_source.hpp"

namespace outrider {

struct LaserTopicsOptions {
  std::string scan = {};            ///< topic; empty: the only one of its type
  std::string odom = {};            ///< topic; empty: the only one of its type, or else /tf
  std::string odom_frame = "odom";  ///< in which /tf moves the robot, if there is no topic with odometry
  std::string base_frame = {};      ///< of the robot; empty: child frame of the odometry, or else "base_link"
};

std::vector<Option> describe(LaserTopicsOptions& options);

/// Opens a log that is read while it is mapped.
Outcome<std::unique_ptr<LaserSource>> open_laser_topics(const std::string& path,
                                                        const LaserTopicsOptions& options);

}  // namespace outrider
