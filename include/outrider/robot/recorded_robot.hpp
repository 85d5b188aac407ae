// RecordedRobot: a Robot that replays recorded observations.
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/robot/robot.hpp"

namespace outrider {

class RecordedRobot final : public Robot {
 public:
  explicit RecordedRobot(std::vector<Observation> records);
  /// Calls `next()`, which returns the next record or nothing at the end, when a record is needed, and holds
  /// no other.
  template <std::invocable Next>
  explicit RecordedRobot(Next next) : next_(std::move(next)) {}

  /// Returns the present record. After the end of the recording, returns only the time and the odometry of
  /// the last record.
  Observation sense() override;
  /// Advances to the next record. The command has no effect, because the recorded motion is fixed. Missions
  /// that only process sensor data send Wait.
  void act(const Command&) override { present_.reset(); }

 private:
  std::function<std::optional<Observation>()> next_;
  std::optional<Observation> present_;
  Observation last_;  ///< time and odometry only
};

}  // namespace outrider
