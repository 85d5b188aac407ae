// The standard ROS messages that Outrider logs, under their own names; those of sensors are in
// ros_sensor_messages.hpp. Fields, their order and their meaning
// are those of ROS 2 (Humble and later); units are SI.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"

namespace outrider {

namespace builtin_interfaces {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;  ///< 0 to 999,999,999

  OUTRIDER_MESSAGE(Time, "builtin_interfaces/msg/Time", (sec, "s"), (nanosec, "ns"))
};

}  // namespace builtin_interfaces

namespace std_msgs {

struct Header {
  builtin_interfaces::Time stamp;
  std::string frame_id;

  OUTRIDER_MESSAGE(Header, "std_msgs/msg/Header", stamp, frame_id)
};

}  // namespace std_msgs

namespace geometry_msgs {

struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  OUTRIDER_MESSAGE(Vector3, "geometry_msgs/msg/Vector3", x, y, z)
};

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  OUTRIDER_MESSAGE(Point, "geometry_msgs/msg/Point", (x, "m"), (y, "m"), (z, "m"))
};

struct Point32 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  OUTRIDER_MESSAGE(Point32, "geometry_msgs/msg/Point32", (x, "m"), (y, "m"), (z, "m"))
};

struct Polygon {
  std::vector<Point32> points;

  OUTRIDER_MESSAGE(Polygon, "geometry_msgs/msg/Polygon", points)
};

struct PolygonStamped {
  std_msgs::Header header;
  Polygon polygon;

  OUTRIDER_MESSAGE(PolygonStamped, "geometry_msgs/msg/PolygonStamped", header, polygon)
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

  OUTRIDER_MESSAGE(Pose, "geometry_msgs/msg/Pose", position, orientation)
};

struct PoseStamped {
  std_msgs::Header header;
  Pose pose;

  OUTRIDER_MESSAGE(PoseStamped, "geometry_msgs/msg/PoseStamped", header, pose)
};

/// A pose with the covariance of x, y, z and the rotations about the axes x, y, z, row by row.
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};

  OUTRIDER_MESSAGE(PoseWithCovariance, "geometry_msgs/msg/PoseWithCovariance", pose, covariance)
};

struct PoseWithCovarianceStamped {
  std_msgs::Header header;
  PoseWithCovariance pose;

  OUTRIDER_MESSAGE(PoseWithCovarianceStamped, "geometry_msgs/msg/PoseWithCovarianceStamped", header, pose)
};

struct Transform {
  Vector3 translation;  ///< m
  Quaternion rotation;

  OUTRIDER_MESSAGE(Transform, "geometry_msgs/msg/Transform", (translation, "m"), rotation)
};

/// The pose of the frame `child_frame_id` in the frame of the header.
struct TransformStamped {
  std_msgs::Header header;
  std::string child_frame_id;
  Transform transform;

  OUTRIDER_MESSAGE(TransformStamped, "geometry_msgs/msg/TransformStamped", header, child_frame_id, transform)
};

struct Twist {
  Vector3 linear;   ///< m/s
  Vector3 angular;  ///< rad/s

  OUTRIDER_MESSAGE(Twist, "geometry_msgs/msg/Twist", (linear, "m/s"), (angular, "rad/s"))
};

struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};

  OUTRIDER_MESSAGE(TwistWithCovariance, "geometry_msgs/msg/TwistWithCovariance", twist, covariance)
};

}  // namespace geometry_msgs

namespace tf2_msgs {

struct TFMessage {
  std::vector<geometry_msgs::TransformStamped> transforms;

  OUTRIDER_MESSAGE(TFMessage, "tf2_msgs/msg/TFMessage", transforms)
};

}  // namespace tf2_msgs

namespace nav_msgs {

/// The pose is that of `child_frame_id` in the frame of the header; the twist is given in `child_frame_id`.
struct Odometry {
  std_msgs::Header header;
  std::string child_frame_id;
  geometry_msgs::PoseWithCovariance pose;
  geometry_msgs::TwistWithCovariance twist;

  OUTRIDER_MESSAGE(Odometry, "nav_msgs/msg/Odometry", header, child_frame_id, pose, twist)
};

struct Path {
  std_msgs::Header header;
  std::vector<geometry_msgs::PoseStamped> poses;

  OUTRIDER_MESSAGE(Path, "nav_msgs/msg/Path", header, poses)
};

struct MapMetaData {
  builtin_interfaces::Time map_load_time;
  float resolution = 0.0F;  ///< side of a cell, m
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  geometry_msgs::Pose origin;  ///< of the lowest corner of the first cell

  OUTRIDER_MESSAGE(MapMetaData, "nav_msgs/msg/MapMetaData", map_load_time, (resolution, "m"),
                   (width, "cells"), (height, "cells"), origin)
};

/// Probabilities of occupancy in percent, row by row from the lowest; -1 is unknown.
struct OccupancyGrid {
  std_msgs::Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;

  OUTRIDER_MESSAGE(OccupancyGrid, "nav_msgs/msg/OccupancyGrid", header, info, (data, "%"))
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

  OUTRIDER_MESSAGE(OccupancyGridUpdate, "map_msgs/msg/OccupancyGridUpdate", header, (x, "cells"),
                   (y, "cells"), (width, "cells"), (height, "cells"), (data, "%"))
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
