// Robot: the port behind which a simulator, a recording, a bridge or hardware does what a mission commands.
#pragma once

#include "outrider/robot/command.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

/// Thread rule: one thread.
class Robot {
 public:
  virtual ~Robot() = default;
  /// What is known now. What happened since the observation before is told once.
  virtual Observation sense() = 0;
  /// Returns when the command is carried out.
  virtual void act(const Command& command) = 0;

 protected:
  Robot() = default;
  Robot(const Robot&) = default;
  Robot& operator=(const Robot&) = default;
};

}  // namespace outrider
