// ScanPoints: where the beams of the newest scan end about the robot.
#pragma once

#include <optional>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/robot_frames.hpp"

namespace outrider {

class ScanPoints {
 public:
  /// Beams longer than that tell nothing.
  explicit ScanPoints(double most_m) : most_m_(most_m) {}

  /// Takes a scan that came at that time of the node. Faults: bad_input for a scan that is older than the
  /// newest or none, and if `frames` does not know where its laser is, or has it upright.
  Status take(const sensor_msgs::LaserScan& message, const RobotFrames& frames, double now_s);

  /// Returns the points in the frame of the robot at the time of the scan.
  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
  /// Returns the time of the scan, and when it came; without meaning, and nothing, before the first.
  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const std::optional<double>& came_s() const { return came_s_; }

 private:
  double most_m_;
  NewestStamp stamps_;
  std::vector<Vec2> points_;
  double time_s_ = 0.0;
  std::optional<double> came_s_;
};

}  // namespace outrider
