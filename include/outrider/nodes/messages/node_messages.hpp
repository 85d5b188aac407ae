// Standard ROS messages that nodes exchange and runs do not log. Fields, their order and their meaning are
// those of ROS 2 (Humble and later).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/ros_messages.hpp"

namespace outrider {

namespace std_msgs {

struct Float64 {
  double data = 0.0;

  OUTRIDER_MESSAGE(Float64, "std_msgs/msg/Float64", data)
};

struct String {
  std::string data;

  OUTRIDER_MESSAGE(String, "std_msgs/msg/String", data)
};

}  // namespace std_msgs

namespace rosgraph_msgs {

/// The time of a simulation.
struct Clock {
  builtin_interfaces::Time clock;

  OUTRIDER_MESSAGE(Clock, "rosgraph_msgs/msg/Clock", clock)
};

}  // namespace rosgraph_msgs

namespace geometry_msgs {

struct TwistStamped {
  std_msgs::Header header;
  Twist twist;

  OUTRIDER_MESSAGE(TwistStamped, "geometry_msgs/msg/TwistStamped", header, twist)
};

}  // namespace geometry_msgs

namespace diagnostic_msgs {

struct KeyValue {
  std::string key;
  std::string value;

  OUTRIDER_MESSAGE(KeyValue, "diagnostic_msgs/msg/KeyValue", key, value)
};

struct DiagnosticStatus {
  std::uint8_t level = 0;  ///< 0 good, 1 warning, 2 error, 3 stale
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;

  static constexpr std::string_view type = "diagnostic_msgs/msg/DiagnosticStatus";
  template <class List>
  static void describe(List& list) {
    list.constant("byte", "OK", 0);
    list.constant("byte", "WARN", 1);
    list.constant("byte", "ERROR", 2);
    list.constant("byte", "STALE", 3);
    list.field("level", &DiagnosticStatus::level);
    list.field("name", &DiagnosticStatus::name);
    list.field("message", &DiagnosticStatus::message);
    list.field("hardware_id", &DiagnosticStatus::hardware_id);
    list.field("values", &DiagnosticStatus::values);
  }
};

}  // namespace diagnostic_msgs

}  // namespace outrider
