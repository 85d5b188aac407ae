// SimulatedTeam: robots on a grid that pursue a target, of whose path they know some seconds ahead.
#pragma once

#include <limits>
#include <vector>

#include "outrider/robot/robot.hpp"

namespace outrider {

class SimulatedTeam final : public Robot {
 public:
  /// `target` has the cells of the target at second 0, 1, ...; they know it `known_s` seconds ahead of now.
  SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target,
                int known_s = std::numeric_limits<int>::max());

  Observation sense() override;
  /// Carries out a StepToCell: a second passes. Other commands take no time.
  void act(const Command& command) override;

 private:
  std::vector<Cell> robots_;
  std::vector<Cell> target_;
  int known_s_;
  int time_s_ = 0;
  std::size_t told_ = 0;  // cells of the target that were sensed
};

}  // namespace outrider
