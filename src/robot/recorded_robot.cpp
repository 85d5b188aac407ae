#include "outrider/robot/recorded_robot.hpp"

namespace outrider {

RecordedRobot::RecordedRobot(std::vector<Observation> records)
    : next_([records = std::move(records), next = std::size_t{0}]() mutable -> std::optional<Observation> {
        if (next >= records.size()) return std::nullopt;
        return std::move(records[next++]);
      }) {}

Observation RecordedRobot::sense() {
  if (!present_) present_ = next_();
  if (!present_) return last_;
  last_.time_s = present_->time_s;
  last_.odometry = present_->odometry;
  return *present_;
}

}  // namespace outrider
