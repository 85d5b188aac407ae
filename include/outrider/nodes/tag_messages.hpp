// Detections of AprilTags as the nodes of apriltag_ros send them (apriltag_msgs). On the wire a point is two
// numbers, whether a version of apriltag_msgs has it as a message or as a part of an array.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/ros_messages.hpp"

namespace outrider::apriltag_msgs {

struct AprilTagDetection {
  std::string family;
  std::int32_t id = 0;
  std::int32_t hamming = 0;  ///< corrected bits
  float goodness = 0.0F;
  float decision_margin = 0.0F;
  std::array<double, 2> centre{};   ///< in the rectified image, from its upper left corner
  std::array<double, 8> corners{};  ///< x, y of each, in the order of libapriltag (estimate/tag.hpp)
  std::array<double, 9> homography{};

  static constexpr std::string_view type = "apriltag_msgs/msg/AprilTagDetection";
  template <class List>
  static void describe(List& list) {
    list.field("family", &AprilTagDetection::family);
    list.field("id", &AprilTagDetection::id);
    list.field("hamming", &AprilTagDetection::hamming);
    list.field("goodness", &AprilTagDetection::goodness);
    list.field("decision_margin", &AprilTagDetection::decision_margin);
    list.field("centre", &AprilTagDetection::centre, "px");
    list.field("corners", &AprilTagDetection::corners, "px");
    list.field("homography", &AprilTagDetection::homography);
  }
};

struct AprilTagDetectionArray {
  std_msgs::Header header;
  std::vector<AprilTagDetection> detections;

  static constexpr std::string_view type = "apriltag_msgs/msg/AprilTagDetectionArray";
  template <class List>
  static void describe(List& list) {
    list.field("header", &AprilTagDetectionArray::header);
    list.field("detections", &AprilTagDetectionArray::detections);
  }
};

}  // namespace outrider::apriltag_msgs
