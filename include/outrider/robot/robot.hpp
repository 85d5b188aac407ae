// Robot: the interface between a mission and what carries it out: a simulator, a recording, a bridge to
// another system, or hardware.
#pragma once

#include "outrider/robot/command.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

/// A robot that senses and acts. Thread rule: use each robot from one thread.
class Robot {
 public:
  virtual ~Robot() = default;
  /// Returns the present observation. Each event since the previous observation is reported once.
  virtual Observation sense() = 0;
  /// Carries out the command and returns when it is done.
  virtual void act(const Command& command) = 0;

 protected:
  Robot() = default;
  Robot(const Robot&) = default;
  Robot& operator=(const Robot&) = default;
};

}  // namespace outrider
