// RecordedRobot: a Robot that replays recorded observations.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/robot/robot.hpp"

namespace outrider {

class RecordedRobot final : public Robot {
 public:
  /// Returns the next record, or nothing at the end.
  using Next = std::function<std::optional<Observation>()>;

  explicit RecordedRobot(std::vector<Observation> records);
  /// Takes each record when it is needed, and holds no other.
  explicit RecordedRobot(Next next) : next_(std::move(next)) {}

  /// Returns the present record. After the end of the recording, returns only the time and the odometry of
  /// the last record.
  Observation sense() override;
  /// Advances to the next record. The command has no effect, because the recorded motion is fixed. Missions
  /// that only process sensor data send Wait.
  void act(const Command&) override { present_.reset(); }

 private:
  Next next_;
  std::optional<Observation> present_;
  Observation last_;  ///< time and odometry only
};

}  // namespace outrider
