// SimulatedTeam: robots on a grid that pursue a target and know its path for some seconds ahead.
#pragma once

#include <limits>
#include <vector>

#include "outrider/robot/robot.hpp"

namespace outrider {

class SimulatedTeam final : public Robot {
 public:
  /// `target` lists the cell of the target at second 0, 1, ... The robots know it until `known_s` seconds
  /// after the present time.
  SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target,
                int known_s = std::numeric_limits<int>::max());

  Observation sense() override;
  /// Carries out a StepToCell, which takes one second. Other commands are ignored and take no time.
  void act(const Command& command) override;

 private:
  std::vector<Cell> robots_;
  std::vector<Cell> target_;
  int known_s_;
  int time_s_ = 0;
  std::size_t told_ = 0;  // cells of the target that were reported
};

}  // namespace outrider
