// Dead reckoning: the belief about the pose between two observations of tags, and its correction by them.
//
// The model: the robot executes each command after `delay_s`, with the lag of a first-order system, and with
// the errors of its wheels (motion_errors.hpp), which are estimated as well. The speed has a further relative
// error `drift` that lasts about a second. So the covariance grows with the time and the square of the speed
// while the robot moves, and stays constant while it stands. This is an extended Kalman filter: Thrun,
// Burgard and Fox, Probabilistic Robotics, section 7.4. Commands are kept until they take effect. O(1) a
// period.
//
// The filter watches its innovations, the differences between what tags say and what it predicted. If they
// are larger on average than their covariance says, it increases the covariances by their ratio, so that it
// follows the tags and states an uncertainty that covers its errors: Mehra, Approaches to adaptive filtering
// (IEEE Transactions on Automatic Control, 1972). A single innovation that is improbably large has less
// weight, since the errors of a tag that is seen from the front are far from normally distributed.
#pragma once

#include <deque>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/estimate/belief.hpp"
#include "outrider/jobs/drive/localisation/motion_errors.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

/// Options of the model.
struct ReckoningOptions {
  double delay_s = 0.07;      ///< delay of a command
  double lag_s = 0.08;        ///< time constant with which the robot follows a command
  double drift = 0.1;         ///< relative standard deviation of the speed and of the turn rate
  double drift_radpm = 0.2;   ///< standard deviation of the turn rate per speed, rad/m
  double wheel_sigma = 0.03;  ///< standard deviation of the error of a wheel at the start, relative
  double slip_sigma = 0.15;   ///< the same of the fraction of sideways motion that is lost
  double lost_m = 0.25;       ///< the robot is lost if the standard deviation of the position is larger
  double lost_rad = 0.5;      ///< the same for the heading
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
  MotionErrors errors;    ///< of the motion, estimated together with the pose
  Twist2 twist;           ///< current velocity if there were no such errors
  Twist2 target;          ///< commanded velocity that takes effect now
  std::deque<Sent> sent;  ///< commands that are not yet in effect
  /// Recent mean of the squared innovations relative to their covariances. About 1 if the covariances are
  /// right, more if the errors are larger than they say.
  double innovation_ratio = 1.0;
};

/// Advances the belief to a later time.
void advance(Reckoning& reckoning, double until_s, const ReckoningOptions& options, const Chassis& chassis);

/// Corrects the belief and the errors of the motion by a pose that is measured at `reckoning.time_s`, with an
/// error that is independent of the belief. Updates `innovation_ratio`.
void correct(Reckoning& reckoning, const PoseBelief& measured);

/// Replaces the belief by a pose that is found without it. Keeps the errors of the motion.
void relocate(Reckoning& reckoning, const PoseBelief& found);

/// Returns true if the robot is believed to stand and no command to move is on its way.
bool is_at_rest(const Reckoning& reckoning);

/// Returns the largest standard deviation of the position over all directions, m.
double position_sigma_m(const PoseBelief& belief);
/// Returns the standard deviation of the heading, rad.
double heading_sigma_rad(const PoseBelief& belief);
/// Returns true if a standard deviation exceeds its limit.
bool is_lost(const PoseBelief& belief, const ReckoningOptions& options);

}  // namespace outrider
