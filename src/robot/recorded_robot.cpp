#include "outrider/robot/recorded_robot.hpp"

namespace outrider {

Observation RecordedRobot::sense() {
  if (present_ < records_.size()) return records_[present_];
  if (records_.empty()) return {};
  return {.time_s = records_.back().time_s, .odometry = records_.back().odometry};
}

}  // namespace outrider
