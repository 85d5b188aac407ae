// The standard ROS messages of sensors and joints. Fields, their order and their meaning are those of ROS 2
// (Humble and later); units are SI.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/ros_messages.hpp"

namespace outrider::sensor_msgs {

/// Ranges at equal angles, counter-clockwise from `angle_min`, in the frame of the header.
struct LaserScan {
  std_msgs::Header header;
  float angle_min = 0.0F;
  float angle_max = 0.0F;
  float angle_increment = 0.0F;
  float time_increment = 0.0F;
  float scan_time = 0.0F;
  float range_min = 0.0F;
  float range_max = 0.0F;
  std::vector<float> ranges;  ///< a range outside [range_min, range_max] is no measurement
  std::vector<float> intensities;

  static constexpr std::string_view type = "sensor_msgs/msg/LaserScan";
  template <class List>
  static void describe(List& list) {
    list.field("header", &LaserScan::header);
    list.field("angle_min", &LaserScan::angle_min, "rad");
    list.field("angle_max", &LaserScan::angle_max, "rad");
    list.field("angle_increment", &LaserScan::angle_increment, "rad");
    list.field("time_increment", &LaserScan::time_increment, "s");
    list.field("scan_time", &LaserScan::scan_time, "s");
    list.field("range_min", &LaserScan::range_min, "m");
    list.field("range_max", &LaserScan::range_max, "m");
    list.field("ranges", &LaserScan::ranges, "m");
    list.field("intensities", &LaserScan::intensities);
  }
};

/// The state of joints, by name.
struct JointState {
  std_msgs::Header header;
  std::vector<std::string> name;
  std::vector<double> position;  ///< rad or m
  std::vector<double> velocity;
  std::vector<double> effort;

  static constexpr std::string_view type = "sensor_msgs/msg/JointState";
  template <class List>
  static void describe(List& list) {
    list.field("header", &JointState::header);
    list.field("name", &JointState::name);
    list.field("position", &JointState::position);
    list.field("velocity", &JointState::velocity);
    list.field("effort", &JointState::effort);
  }
};

struct RegionOfInterest {
  std::uint32_t x_offset = 0;
  std::uint32_t y_offset = 0;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  bool do_rectify = false;

  static constexpr std::string_view type = "sensor_msgs/msg/RegionOfInterest";
  template <class List>
  static void describe(List& list) {
    list.field("x_offset", &RegionOfInterest::x_offset, "px");
    list.field("y_offset", &RegionOfInterest::y_offset, "px");
    list.field("height", &RegionOfInterest::height, "px");
    list.field("width", &RegionOfInterest::width, "px");
    list.field("do_rectify", &RegionOfInterest::do_rectify);
  }
};

/// The intrinsic parameters of a camera. `k`, `r` and `p` are matrices row by row.
struct CameraInfo {
  std_msgs::Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{};
  std::array<double, 9> r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0;
  std::uint32_t binning_y = 0;
  RegionOfInterest roi;

  static constexpr std::string_view type = "sensor_msgs/msg/CameraInfo";
  template <class List>
  static void describe(List& list) {
    list.field("header", &CameraInfo::header);
    list.field("height", &CameraInfo::height, "px");
    list.field("width", &CameraInfo::width, "px");
    list.field("distortion_model", &CameraInfo::distortion_model);
    list.field("d", &CameraInfo::d);
    list.field("k", &CameraInfo::k);
    list.field("r", &CameraInfo::r);
    list.field("p", &CameraInfo::p);
    list.field("binning_x", &CameraInfo::binning_x);
    list.field("binning_y", &CameraInfo::binning_y);
    list.field("roi", &CameraInfo::roi);
  }
};

/// The pixels of a camera, row by row from the top.
struct Image {
  std_msgs::Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding;  ///< such as "mono8", "rgb8" or "bgr8"
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;  ///< length of a row
  std::vector<std::uint8_t> data;

  static constexpr std::string_view type = "sensor_msgs/msg/Image";
  template <class List>
  static void describe(List& list) {
    list.field("header", &Image::header);
    list.field("height", &Image::height, "px");
    list.field("width", &Image::width, "px");
    list.field("encoding", &Image::encoding);
    list.field("is_bigendian", &Image::is_bigendian);
    list.field("step", &Image::step, "bytes");
    list.field("data", &Image::data);
  }
};

/// An image as a JPEG or PNG file.
struct CompressedImage {
  std_msgs::Header header;
  std::string format;
  std::vector<std::uint8_t> data;

  static constexpr std::string_view type = "sensor_msgs/msg/CompressedImage";
  template <class List>
  static void describe(List& list) {
    list.field("header", &CompressedImage::header);
    list.field("format", &CompressedImage::format);
    list.field("data", &CompressedImage::data);
  }
};

}  // namespace outrider::sensor_msgs
