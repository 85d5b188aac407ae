// Standard ROS messages that nodes exchange and runs do not log. Fields, their order and their meaning are
// those of ROS 2 (Humble and later).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/ros_messages.hpp"

namespace outrider {

namespace std_msgs {

struct Float64 {
  double data = 0.0;

  static constexpr std::string_view type = "std_msgs/msg/Float64";
  template <class List>
  static void describe(List& list) {
    list.field("data", &Float64::data);
  }
};

struct String {
  std::string data;

  static constexpr std::string_view type = "std_msgs/msg/String";
  template <class List>
  static void describe(List& list) {
    list.field("data", &String::data);
  }
};

}  // namespace std_msgs

namespace rosgraph_msgs {

/// The time of a simulation.
struct Clock {
  builtin_interfaces::Time clock;

  static constexpr std::string_view type = "rosgraph_msgs/msg/Clock";
  template <class List>
  static void describe(List& list) {
    list.field("clock", &Clock::clock);
  }
};

}  // namespace rosgraph_msgs

namespace geometry_msgs {

struct TwistStamped {
  std_msgs::Header header;
  Twist twist;

  static constexpr std::string_view type = "geometry_msgs/msg/TwistStamped";
  template <class List>
  static void describe(List& list) {
    list.field("header", &TwistStamped::header);
    list.field("twist", &TwistStamped::twist);
  }
};

struct Point32 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  static constexpr std::string_view type = "geometry_msgs/msg/Point32";
  template <class List>
  static void describe(List& list) {
    list.field("x", &Point32::x, "m");
    list.field("y", &Point32::y, "m");
    list.field("z", &Point32::z, "m");
  }
};

struct Polygon {
  std::vector<Point32> points;

  static constexpr std::string_view type = "geometry_msgs/msg/Polygon";
  template <class List>
  static void describe(List& list) {
    list.field("points", &Polygon::points);
  }
};

struct PolygonStamped {
  std_msgs::Header header;
  Polygon polygon;

  static constexpr std::string_view type = "geometry_msgs/msg/PolygonStamped";
  template <class List>
  static void describe(List& list) {
    list.field("header", &PolygonStamped::header);
    list.field("polygon", &PolygonStamped::polygon);
  }
};

}  // namespace geometry_msgs

namespace diagnostic_msgs {

struct KeyValue {
  std::string key;
  std::string value;

  static constexpr std::string_view type = "diagnostic_msgs/msg/KeyValue";
  template <class List>
  static void describe(List& list) {
    list.field("key", &KeyValue::key);
    list.field("value", &KeyValue::value);
  }
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
