// Chooses the channel of a type in a log.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

/// The topic that is looked for.
struct TopicWish {
  std::vector<std::string_view> types;  ///< ROS 2 names, such as "sensor_msgs/msg/LaserScan": any of them
  std::string topic;                    ///< the name that the user gave; empty: the only topic of the type
  std::string_view option;              ///< the option that names it, such as "--scan"; part of the fault
};

/// Returns the indices of the channels of the topic: one, or several if several nodes sent to it in ROS 1.
/// With a name, the topic must exist and have one of the types; without one, it must be the only one of these
/// types. Fault: bad_input that lists the topics of these types and names the option.
Outcome<std::vector<std::size_t>> find_topic(const std::vector<Channel>& channels, const TopicWish& wish);

}  // namespace outrider
