// Dead reckoning: what a robot believes of its pose between two looks at the tags.
//
// The robot is taken to do what it is commanded, `delay` later and with the lag of a first-order system. The
// speed is off by a part `drift` that lasts about a second, so while the robot moves the covariance grows
// with the time and the square of the speed; while it stands nothing grows. Linearised about the belief, as
// in an extended Kalman filter: Thrun, Burgard and Fox, Probabilistic Robotics, section 7.4.
// Commands are kept until they take effect. O(1) a period.
#pragma once

#include <deque>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/estimate/belief.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

struct ReckoningOptions {
  double delay_s = 0.07;     ///< of a command
  double lag_s = 0.08;       ///< time constant with which the robot follows it
  double drift = 0.1;        ///< standard deviation of the speed and of the turn rate, relative
  double drift_radpm = 0.2;  ///< and of the turn rate, per speed, rad/m
  double lost_m = 0.25;      ///< a belief with a larger standard deviation is lost
  double lost_rad = 0.5;
};
std::vector<Option> describe(ReckoningOptions& options);

struct Reckoning {
  struct Sent {
    double at_s = 0.0;
    Twist2 twist;
  };
  double time_s = 0.0;
  PoseBelief belief;
  Twist2 twist;           ///< as it is believed to be now
  Twist2 target;          ///< which it follows
  std::deque<Sent> sent;  ///< not yet in effect
};

/// The belief at a later time.
void advance(Reckoning& reckoning, double until_s, const ReckoningOptions& options);

/// The standard deviation of the position along the worst direction, m, and of the heading, rad.
double position_sigma_m(const PoseBelief& belief);
double heading_sigma_rad(const PoseBelief& belief);
bool is_lost(const PoseBelief& belief, const ReckoningOptions& options);

}  // namespace outrider
