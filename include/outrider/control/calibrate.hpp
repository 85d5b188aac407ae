// Calibrate: estimates the gains of wheels and directions, and the laws of straight motions and turns, from
// recorded runs.
//
// A run is one steady command in one direction, from rest to rest, with the resulting pose relative to its
// start. The runs of one direction and speed determine a law distance = a t + b (or angle = a t + b) by
// ordinary least squares, with 95 % confidence intervals by Student's t. The gain of a direction is the mean
// of a / commanded speed over its laws, and its dead time the mean of -b / a, both weighted by the number of
// runs.
//
// A run that does not fit the others of its direction and speed, in distance, to the side or in heading, is
// left out and named: one mistyped number does not change the calibration. One in a million good runs is left
// out too. A group of fewer than 8 runs tells too little for that.
//
// The motion of a run beside its direction distinguishes the wheels. After gains and dead times are removed,
// twist - command = J^+ diag(J command) (g - 1) is linear in the wheel gains g (J: chassis.hpp). It is solved
// over all runs by least squares; the mean of g is 1 by definition. A combination of gains that no run
// determines keeps the value 1 and gets an infinite interval.
//
// Faults: bad_input, with the line of the run, for a command in several directions or none, a time that is
// not positive, a turn of 300 degrees or more during a straight motion, fewer than 3 runs or only one time
// for a law, more than a fifth of the runs that do not fit the others, or a law by which the robot does not
// move in the commanded direction. O(runs).
#pragma once

#include <string>
#include <vector>

#include "outrider/control/calibration.hpp"

namespace outrider {

/// A recorded run.
struct CalibrationRun {
  Twist2 command;  ///< command in one direction
  double time_s = 0.0;
  Pose2 start_T_end;  ///< resulting pose; the heading is not wrapped
  std::string where;  ///< file and line, for messages
};

/// A number with its 95 % confidence interval.
struct Estimate95 {
  double value = 0.0;
  double half_width = 0.0;
};

/// The law of one direction and speed.
struct FittedLaw {
  Direction direction = Direction::ahead;
  double command = 0.0;      ///< m/s or rad/s, > 0
  Estimate95 slope;          ///< a, m/s or rad/s
  Estimate95 offset;         ///< b, m or rad
  double residual_sd = 0.0;  ///< standard deviation of the residuals, m or rad
  std::vector<Vec2> points;  ///< by run: time (s), and distance (m) or angle (rad)
  double mean_time_s = 0.0;
  double time_square_sum = 0.0;  ///< sum of squared deviations from the mean, s^2
};

/// A run that does not fit the others.
struct LeftOutRun {
  std::string where;     ///< of the run
  std::string sentence;  ///< by how much it is off
};

/// The result of calibrate().
struct CalibrationFit {
  Calibration calibration;
  std::vector<FittedLaw> laws;     ///< laws by direction, then by command
  std::vector<Estimate95> wheels;  ///< gain of each wheel
  std::vector<LeftOutRun> left_out;
};

/// Fits a calibration to runs as described above.
Outcome<CalibrationFit> calibrate(const Chassis& chassis, const std::vector<CalibrationRun>& runs);

/// Returns half the width of the 95 % confidence band of a law at a time, in the unit of the law.
double confidence_half_width(const FittedLaw& law, double time_s);

/// Returns the 97.5 % quantile of Student's t for 1 or more degrees of freedom, to 0.2 %; exact for 1 and 2.
/// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.5.
double student_quantile(std::size_t degrees);

}  // namespace outrider
