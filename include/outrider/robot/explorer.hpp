// ExplorerRobot: the port behind which a robot with a range finder explores, simulated or real.
#pragma once

#include <optional>

#include "outrider/geometry/pose.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

struct ExplorerObservation {
  double time_s = 0.0;
  Pose2 odometry;                 ///< start_T_robot by the wheels, which drift; the heading is not wrapped
  std::optional<LaserScan> scan;  ///< taken since the observation before, at time_s
  bool touching = false;          ///< its bumper is pressed
};

/// A twist to keep until a time at which the robot wants to sense again.
struct ExplorerCommand {
  Twist2 twist;
  double until_s = 0.0;
};

class ExplorerRobot {
 public:
  virtual ~ExplorerRobot() = default;
  virtual ExplorerObservation sense() = 0;
  /// Returns at command.until_s.
  virtual void act(const ExplorerCommand& command) = 0;

 protected:
  ExplorerRobot() = default;
  ExplorerRobot(const ExplorerRobot&) = default;
  ExplorerRobot& operator=(const ExplorerRobot&) = default;
};

}  // namespace outrider
