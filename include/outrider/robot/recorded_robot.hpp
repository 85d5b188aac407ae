// RecordedRobot: a Robot that replays recorded observations.
#pragma once

#include <utility>
#include <vector>

#include "outrider/robot/robot.hpp"

namespace outrider {

class RecordedRobot final : public Robot {
 public:
  explicit RecordedRobot(std::vector<Observation> records) : records_(std::move(records)) {}

  /// Returns the present record. After the end of the recording, returns only the time and the odometry of
  /// the last record.
  Observation sense() override;
  /// Advances to the next record. The command has no effect, because the recorded motion is fixed. Missions
  /// that only process sensor data send Wait.
  void act(const Command&) override { ++present_; }

 private:
  std::vector<Observation> records_;
  std::size_t present_ = 0;
};

}  // namespace outrider
