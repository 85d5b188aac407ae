// Names of ROS 2 and what they are called on the wire.
//
// A relative name belongs to the namespace, and one that begins with ~ to the node in it. On the wire the
// topic
// "/scan" is "rt/scan", and the type "sensor_msgs/msg/LaserScan" is "sensor_msgs::msg::dds_::LaserScan_".
// Source: design.ros2.org, "Topic and Service name mapping to DDS".
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// The node whose names are resolved.
struct RosNamespace {
  std::string space = "/";        ///< absolute, such as "/robot_1"
  std::string node = "outrider";  ///< name without slashes
};

/// Returns the absolute name of a topic. Faults: bad_input for a name that ROS 2 does not take: its parts,
/// between slashes, are letters, digits and underscores, do not begin with a digit, and are not empty.
Outcome<std::string> resolve_topic(std::string_view name, const RosNamespace& of = {});

/// Returns the absolute namespace of a name such as "robot_1" or "/robot_1"; "/" for "" and "/". Faults:
/// those of resolve_topic().
Outcome<std::string> resolve_namespace(std::string_view name);

/// Renames topics: "from:=to", as ROS 2 has it; both names are resolved.
class TopicNames {
 public:
  /// Faults: bad_input for a rule that is none, and for names that resolve_topic() refuses.
  static Outcome<TopicNames> of(const RosNamespace& space, const std::vector<std::string>& rules);

  /// Returns the absolute name under which a topic is used. Faults: those of resolve_topic().
  [[nodiscard]] Outcome<std::string> name_of(std::string_view topic) const;

 private:
  RosNamespace space_;
  std::map<std::string, std::string> renamed_;
};

/// Returns the name of an absolute topic on the wire.
std::string topic_on_wire(std::string_view topic);

/// Return the names of the two topics of an absolute service on the wire: "rq/mapper/get_parametersRequest"
/// and "rr/mapper/get_parametersReply".
std::string request_on_wire(std::string_view service);
std::string reply_on_wire(std::string_view service);

/// Returns the name of a message type, such as "sensor_msgs/msg/LaserScan", on the wire.
std::string type_on_wire(std::string_view type);

}  // namespace outrider
