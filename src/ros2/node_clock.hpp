// RunClock: the time of a node that is connected to ROS 2.
#pragma once

#include <optional>
#include <string>

#include "outrider/ros2/run_node.hpp"

namespace outrider {

class RunClock {
 public:
  static Outcome<RunClock> of(RosNode& network, const RunNodeOptions& options);

  /// Returns the time, s; nothing before /clock has come. Its own clock steps by at most `step_s`.
  std::optional<double> now(double step_s);
  /// Returns a sentence if /clock has not moved for 2 s; once each time.
  std::optional<std::string> silent();

 private:
  explicit RunClock(const RunNodeOptions& options);

  NodeClock kind_;
  double rate_;
  std::optional<RosReader> clock_;
  std::optional<double> simulated_s_;
  double moved_wall_s_ = 0.0;  ///< when the time of the simulation moved
  bool told_ = false;
  double own_s_ = 0.0;
  double own_wall_s_ = 0.0;  ///< when its own clock showed that
};

}  // namespace outrider
