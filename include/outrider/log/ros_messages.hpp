// The standard ROS messages that Outrider logs, under their own names; those of sensors are in
// ros_sensor_messages.hpp. Fields, their order and their meaning
// are those of ROS 2 (Humble and later); units are SI.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace outrider {

namespace builtin_interfaces {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;  ///< 0 to 999,999,999

  static constexpr std::string_view type = "builtin_interfaces/msg/Time";
  template <class List>
  static void describe(List& list) {
    list.field("sec", &Time::sec, "s");
    list.field("nanosec", &Time::nanosec, "ns");
  }
};

}  // namespace builtin_interfaces

namespace std_msgs {

struct Header {
  builtin_interfaces::Time stamp;
  std::string frame_id;

  static constexpr std::string_view type = "std_msgs/msg/Header";
  template <class List>
  static void describe(List& list) {
    list.field("stamp", &Header::stamp);
    list.field("frame_id", &Header::frame_id);
  }
};

}  // namespace std_msgs

namespace geometry_msgs {

struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  static constexpr std::string_view type = "geometry_msgs/msg/Vector3";
  template <class List>
  static void describe(List& list) {
    list.field("x", &Vector3::x);
    list.field("y", &Vector3::y);
    list.field("z", &Vector3::z);
  }
};

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  static constexpr std::string_view type = "geometry_msgs/msg/Point";
  template <class List>
  static void describe(List& list) {
    list.field("x", &Point::x, "m");
    list.field("y", &Point::y, "m");
    list.field("z", &Point::z, "m");
  }
};

struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;

  static constexpr std::string_view type = "geometry_msgs/msg/Quaternion";
  template <class List>
  static void describe(List& list) {
    list.field("x", &Quaternion::x, "", "0");
    list.field("y", &Quaternion::y, "", "0");
    list.field("z", &Quaternion::z, "", "0");
    list.field("w", &Quaternion::w, "", "1");
  }
};

struct Pose {
  Point position;
  Quaternion orientation;

  static constexpr std::string_view type = "geometry_msgs/msg/Pose";
  template <class List>
  static void describe(List& list) {
    list.field("position", &Pose::position);
    list.field("orientation", &Pose::orientation);
  }
};

struct PoseStamped {
  std_msgs::Header header;
  Pose pose;

  static constexpr std::string_view type = "geometry_msgs/msg/PoseStamped";
  template <class List>
  static void describe(List& list) {
    list.field("header", &PoseStamped::header);
    list.field("pose", &PoseStamped::pose);
  }
};

/// A pose with the covariance of x, y, z and the rotations about the axes x, y, z, row by row.
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};

  static constexpr std::string_view type = "geometry_msgs/msg/PoseWithCovariance";
  template <class List>
  static void describe(List& list) {
    list.field("pose", &PoseWithCovariance::pose);
    list.field("covariance", &PoseWithCovariance::covariance);
  }
};

struct PoseWithCovarianceStamped {
  std_msgs::Header header;
  PoseWithCovariance pose;

  static constexpr std::string_view type = "geometry_msgs/msg/PoseWithCovarianceStamped";
  template <class List>
  static void describe(List& list) {
    list.field("header", &PoseWithCovarianceStamped::header);
    list.field("pose", &PoseWithCovarianceStamped::pose);
  }
};

struct Transform {
  Vector3 translation;  ///< m
  Quaternion rotation;

  static constexpr std::string_view type = "geometry_msgs/msg/Transform";
  template <class List>
  static void describe(List& list) {
    list.field("translation", &Transform::translation, "m");
    list.field("rotation", &Transform::rotation);
  }
};

/// The pose of the frame `child_frame_id` in the frame of the header.
struct TransformStamped {
  std_msgs::Header header;
  std::string child_frame_id;
  Transform transform;

  static constexpr std::string_view type = "geometry_msgs/msg/TransformStamped";
  template <class List>
  static void describe(List& list) {
    list.field("header", &TransformStamped::header);
    list.field("child_frame_id", &TransformStamped::child_frame_id);
    list.field("transform", &TransformStamped::transform);
  }
};

struct Twist {
  Vector3 linear;   ///< m/s
  Vector3 angular;  ///< rad/s

  static constexpr std::string_view type = "geometry_msgs/msg/Twist";
  template <class List>
  static void describe(List& list) {
    list.field("linear", &Twist::linear, "m/s");
    list.field("angular", &Twist::angular, "rad/s");
  }
};

struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};

  static constexpr std::string_view type = "geometry_msgs/msg/TwistWithCovariance";
  template <class List>
  static void describe(List& list) {
    list.field("twist", &TwistWithCovariance::twist);
    list.field("covariance", &TwistWithCovariance::covariance);
  }
};

}  // namespace geometry_msgs

namespace tf2_msgs {

struct TFMessage {
  std::vector<geometry_msgs::TransformStamped> transforms;

  static constexpr std::string_view type = "tf2_msgs/msg/TFMessage";
  template <class List>
  static void describe(List& list) {
    list.field("transforms", &TFMessage::transforms);
  }
};

}  // namespace tf2_msgs

namespace nav_msgs {

/// The pose is that of `child_frame_id` in the frame of the header; the twist is given in `child_frame_id`.
struct Odometry {
  std_msgs::Header header;
  std::string child_frame_id;
  geometry_msgs::PoseWithCovariance pose;
  geometry_msgs::TwistWithCovariance twist;

  static constexpr std::string_view type = "nav_msgs/msg/Odometry";
  template <class List>
  static void describe(List& list) {
    list.field("header", &Odometry::header);
    list.field("child_frame_id", &Odometry::child_frame_id);
    list.field("pose", &Odometry::pose);
    list.field("twist", &Odometry::twist);
  }
};

struct Path {
  std_msgs::Header header;
  std::vector<geometry_msgs::PoseStamped> poses;

  static constexpr std::string_view type = "nav_msgs/msg/Path";
  template <class List>
  static void describe(List& list) {
    list.field("header", &Path::header);
    list.field("poses", &Path::poses);
  }
};

struct MapMetaData {
  builtin_interfaces::Time map_load_time;
  float resolution = 0.0F;  ///< side of a cell, m
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  geometry_msgs::Pose origin;  ///< of the lowest corner of the first cell

  static constexpr std::string_view type = "nav_msgs/msg/MapMetaData";
  template <class List>
  static void describe(List& list) {
    list.field("map_load_time", &MapMetaData::map_load_time);
    list.field("resolution", &MapMetaData::resolution, "m");
    list.field("width", &MapMetaData::width, "cells");
    list.field("height", &MapMetaData::height, "cells");
    list.field("origin", &MapMetaData::origin);
  }
};

/// Probabilities of occupancy in percent, row by row from the lowest; -1 is unknown.
struct OccupancyGrid {
  std_msgs::Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;

  static constexpr std::string_view type = "nav_msgs/msg/OccupancyGrid";
  template <class List>
  static void describe(List& list) {
    list.field("header", &OccupancyGrid::header);
    list.field("info", &OccupancyGrid::info);
    list.field("data", &OccupancyGrid::data, "%");
  }
};

}  // namespace nav_msgs

namespace map_msgs {

/// New values of a rectangle of an OccupancyGrid; x and y are the column and row of its lowest corner.
struct OccupancyGridUpdate {
  std_msgs::Header header;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::int8_t> data;

  static constexpr std::string_view type = "map_msgs/msg/OccupancyGridUpdate";
  template <class List>
  static void describe(List& list) {
    list.field("header", &OccupancyGridUpdate::header);
    list.field("x", &OccupancyGridUpdate::x, "cells");
    list.field("y", &OccupancyGridUpdate::y, "cells");
    list.field("width", &OccupancyGridUpdate::width, "cells");
    list.field("height", &OccupancyGridUpdate::height, "cells");
    list.field("data", &OccupancyGridUpdate::data, "%");
  }
};

}  // namespace map_msgs

namespace rcl_interfaces {

/// A line of the log of a node: the messages of /rosout.
struct Log {
  builtin_interfaces::Time stamp;
  std::uint8_t level = 20;  ///< 10 debug, 20 info, 30 warning, 40 error, 50 fatal
  std::string name;
  std::string msg;
  std::string file;
  std::string function;
  std::uint32_t line = 0;

  static constexpr std::string_view type = "rcl_interfaces/msg/Log";
  template <class List>
  static void describe(List& list) {
    list.constant("byte", "DEBUG", 10);
    list.constant("byte", "INFO", 20);
    list.constant("byte", "WARN", 30);
    list.constant("byte", "ERROR", 40);
    list.constant("byte", "FATAL", 50);
    list.field("stamp", &Log::stamp);
    list.field("level", &Log::level);
    list.field("name", &Log::name);
    list.field("msg", &Log::msg);
    list.field("file", &Log::file);
    list.field("function", &Log::function);
    list.field("line", &Log::line);
  }
};

}  // namespace rcl_interfaces

}  // namespace outrider
