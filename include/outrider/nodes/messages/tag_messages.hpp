// Detections of AprilTags as the nodes of apriltag_ros send them (apriltag_msgs). On the wire a point is two
// numbers, whether a version of apriltag_msgs has it as a message or as a part of an array.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/ros_messages.hpp"

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

  OUTRIDER_MESSAGE(AprilTagDetection, "apriltag_msgs/msg/AprilTagDetection", family, id, hamming, goodness,
                   decision_margin, (centre, "px"), (corners, "px"), homography)
};

struct AprilTagDetectionArray {
  std_msgs::Header header;
  std::vector<AprilTagDetection> detections;

  OUTRIDER_MESSAGE(AprilTagDetectionArray, "apriltag_msgs/msg/AprilTagDetectionArray", header, detections)
};

}  // namespace outrider::apriltag_msgs
