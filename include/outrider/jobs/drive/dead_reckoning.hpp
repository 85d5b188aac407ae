// Dead reckoning: the belief about the pose between two observations of tags.
//
// The model: the robot executes each command after `delay_s`, with the lag of a first-order system. The speed
// has a relative error `drift` that lasts about a second. So the covariance grows with the time and the
// square of the speed while the robot moves, and stays constant while it stands. Linearised about the belief,
// as in an extended Kalman filter: Thrun, Burgard and Fox, Probabilistic Robotics, section 7.4. Commands are
// kept until they take effect. O(1) a period.
#pragma once

#include <deque>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/estimate/belief.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// Options of the model.
struct ReckoningOptions {
  double delay_s = 0.07;     ///< delay of a command
  double lag_s = 0.08;       ///< time constant with which the robot follows a command
  double drift = 0.1;        ///< relative standard deviation of the speed and of the turn rate
  double drift_radpm = 0.2;  ///< standard deviation of the turn rate per speed, rad/m
  double lost_m = 0.25;      ///< the robot is lost if the standard deviation of the position is larger
  double lost_rad = 0.5;     ///< the same for the heading
};
/// Describes the options by name.
std::vector<Option> describe(ReckoningOptions& options);

/// The state of dead reckoning.
struct Reckoning {
  /// A command and when it was sent.
  struct Sent {
    double at_s = 0.0;
    Twist2 twist;
  };
  double time_s = 0.0;
  PoseBelief belief;      ///< at time_s
  Twist2 twist;           ///< believed current velocity
  Twist2 target;          ///< commanded velocity that takes effect now
  std::deque<Sent> sent;  ///< commands that are not yet in effect
};

/// Advances the belief to a later time.
void advance(Reckoning& reckoning, double until_s, const ReckoningOptions& options);

/// Returns the largest standard deviation of the position over all directions, m.
double position_sigma_m(const PoseBelief& belief);
/// Returns the standard deviation of the heading, rad.
double heading_sigma_rad(const PoseBelief& belief);
/// Returns true if a standard deviation exceeds its limit.
bool is_lost(const PoseBelief& belief, const ReckoningOptions& options);

}  // namespace outrider
