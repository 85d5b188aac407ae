// The standard ROS messages of sensors and joints. Fields, their order and their meaning are those of ROS 2
// (Humble and later); units are SI.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/ros_messages.hpp"

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

  OUTRIDER_MESSAGE(LaserScan, "sensor_msgs/msg/LaserScan", header, (angle_min, "rad"), (angle_max, "rad"),
                   (angle_increment, "rad"), (time_increment, "s"), (scan_time, "s"), (range_min, "m"),
                   (range_max, "m"), (ranges, "m"), intensities)
};

/// The state of joints, by name.
struct JointState {
  std_msgs::Header header;
  std::vector<std::string> name;
  std::vector<double> position;  ///< rad or m
  std::vector<double> velocity;
  std::vector<double> effort;

  OUTRIDER_MESSAGE(JointState, "sensor_msgs/msg/JointState", header, name, position, velocity, effort)
};

struct RegionOfInterest {
  std::uint32_t x_offset = 0;
  std::uint32_t y_offset = 0;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  bool do_rectify = false;

  OUTRIDER_MESSAGE(RegionOfInterest, "sensor_msgs/msg/RegionOfInterest", (x_offset, "px"), (y_offset, "px"),
                   (height, "px"), (width, "px"), do_rectify)
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

  OUTRIDER_MESSAGE(CameraInfo, "sensor_msgs/msg/CameraInfo", header, (height, "px"), (width, "px"),
                   distortion_model, d, k, r, p, binning_x, binning_y, roi)
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

  OUTRIDER_MESSAGE(Image, "sensor_msgs/msg/Image", header, (height, "px"), (width, "px"), encoding,
                   is_bigendian, (step, "bytes"), data)
};

/// An image as a JPEG or PNG file.
struct CompressedImage {
  std_msgs::Header header;
  std::string format;
  std::vector<std::uint8_t> data;

  OUTRIDER_MESSAGE(CompressedImage, "sensor_msgs/msg/CompressedImage", header, format, data)
};

}  // namespace outrider::sensor_msgs
