// RecordedRobot: a recording behind the port.
#pragma once

#include <utility>
#include <vector>

#include "outrider/robot/robot.hpp"

namespace outrider {

class RecordedRobot final : public Robot {
 public:
  explicit RecordedRobot(std::vector<Observation> records) : records_(std::move(records)) {}

  /// The present record; after the last one nothing but its time and odometry.
  Observation sense() override;
  /// Goes on to the next record, whatever the command: the robot did what it did. Missions that only listen
  /// command it to Wait.
  void act(const Command&) override { ++present_; }

 private:
  std::vector<Observation> records_;
  std::size_t present_ = 0;
};

}  // namespace outrider
