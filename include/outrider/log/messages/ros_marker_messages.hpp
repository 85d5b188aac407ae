// The standard ROS messages with markers: shapes that every viewer draws. Fields, their order and their
// meaning are those of ROS 2 (Humble and later).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {

namespace builtin_interfaces {

struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  OUTRIDER_MESSAGE(Duration, "builtin_interfaces/msg/Duration", (sec, "s"), (nanosec, "ns"))
};

}  // namespace builtin_interfaces

namespace std_msgs {

/// A colour; each part is from 0 to 1.
struct ColorRGBA {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 1.0F;

  OUTRIDER_MESSAGE(ColorRGBA, "std_msgs/msg/ColorRGBA", r, g, b, a)
};

}  // namespace std_msgs

namespace visualization_msgs {

struct UVCoordinate {
  float u = 0.0F;
  float v = 0.0F;

  OUTRIDER_MESSAGE(UVCoordinate, "visualization_msgs/msg/UVCoordinate", u, v)
};

struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;

  OUTRIDER_MESSAGE(MeshFile, "visualization_msgs/msg/MeshFile", filename, data)
};

/// A shape, or a list of points, lines or triangles, in the frame of the header.
struct Marker {
  static constexpr std::int32_t cube = 1, cylinder = 3, line_list = 5, text_view_facing = 9,
                                triangle_list = 11;

  std_msgs::Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t shape = cube;  ///< the field `type`
  std::int32_t action = 0;
  geometry_msgs::Pose pose;
  geometry_msgs::Vector3 scale;  ///< size of a shape; x: width of lines; z: height of a text
  std_msgs::ColorRGBA color;
  builtin_interfaces::Duration lifetime;  ///< 0: for ever
  bool frame_locked = false;
  std::vector<geometry_msgs::Point> points;
  std::vector<std_msgs::ColorRGBA> colors;
  std::string texture_resource;
  sensor_msgs::CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;

  static constexpr std::string_view type = "visualization_msgs/msg/Marker";
  template <class List>
  static void describe(List& list) {
    constexpr std::string_view shapes[] = {
        "ARROW",     "CUBE",        "SPHERE", "CYLINDER",         "LINE_STRIP",    "LINE_LIST",
        "CUBE_LIST", "SPHERE_LIST", "POINTS", "TEXT_VIEW_FACING", "MESH_RESOURCE", "TRIANGLE_LIST"};
    for (int i = 0; i < 12; ++i) list.constant("int32", shapes[i], i);
    list.constant("int32", "ADD", 0);
    list.constant("int32", "MODIFY", 0);
    list.constant("int32", "DELETE", 2);
    list.constant("int32", "DELETEALL", 3);
    list.field("header", &Marker::header);
    list.field("ns", &Marker::ns);
    list.field("id", &Marker::id);
    list.field("type", &Marker::shape);
    list.field("action", &Marker::action);
    list.field("pose", &Marker::pose);
    list.field("scale", &Marker::scale, "m");
    list.field("color", &Marker::color);
    list.field("lifetime", &Marker::lifetime);
    list.field("frame_locked", &Marker::frame_locked);
    list.field("points", &Marker::points);
    list.field("colors", &Marker::colors);
    list.field("texture_resource", &Marker::texture_resource);
    list.field("texture", &Marker::texture);
    list.field("uv_coordinates", &Marker::uv_coordinates);
    list.field("text", &Marker::text);
    list.field("mesh_resource", &Marker::mesh_resource);
    list.field("mesh_file", &Marker::mesh_file);
    list.field("mesh_use_embedded_materials", &Marker::mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  std::vector<Marker> markers;

  OUTRIDER_MESSAGE(MarkerArray, "visualization_msgs/msg/MarkerArray", markers)
};

}  // namespace visualization_msgs

}  // namespace outrider
