// Calibrate: the gains of wheels and directions and the laws of straights and turns, from recorded runs.
//
// A run is one steady command in one direction, from rest to rest, and the pose that it led to, seen from
// where it began. Runs of one direction and speed give a law distance = a t + b (or angle = a t + b) by
// ordinary least squares, with 95 % confidence intervals by Student's t. The gain of a direction is the mean
// of a / commanded speed over its laws, and its dead time that of -b / a, each weighed by its runs.
//
// What a run does beside its direction tells the wheels apart: with the gains and dead times taken out,
// twist - command = J^+ diag(J command) (g - 1) is linear in the gains g of the wheels (J: chassis.hpp), and
// is solved over all runs by least squares; their mean is 1 by definition. A combination of gains that no run
// determines keeps the value 1 and gets an infinite interval.
//
// Errors: bad_input, in the words of the run's line, on a command in several directions or none, times that
// are not positive, a turn of 300 degrees or more beside a straight, fewer than 3 runs or only one time for
// a law, or a law by which the robot does not move where it is told. O(runs).
#pragma once

#include <string>
#include <vector>

#include "outrider/control/calibration.hpp"

namespace outrider {

struct CalibrationRun {
  Twist2 command;  ///< in one direction
  double time_s = 0.0;
  Pose2 start_T_end;  ///< heading not wrapped
  std::string where;  ///< file and line, for faults
};

/// A number with its 95 % confidence interval.
struct Estimate95 {
  double value = 0.0;
  double half_width = 0.0;
};

struct FittedLaw {
  Direction direction = Direction::ahead;
  double command = 0.0;      ///< m/s or rad/s, > 0
  Estimate95 slope;          ///< a, m/s or rad/s
  Estimate95 offset;         ///< b, m or rad
  double residual_sd = 0.0;  ///< standard deviation of the residuals, m or rad
  std::vector<Vec2> points;  ///< of each run: time (s), distance (m) or angle (rad)
  double mean_time_s = 0.0;
  double time_square_sum = 0.0;  ///< about the mean, s^2
};

struct CalibrationFit {
  Calibration calibration;
  std::vector<FittedLaw> laws;     ///< by direction, then by command
  std::vector<Estimate95> wheels;  ///< by wheel
};

Outcome<CalibrationFit> calibrate(const Chassis& chassis, const std::vector<CalibrationRun>& runs);

/// Half the width of the 95 % confidence band of a law at that time.
double confidence_half_width(const FittedLaw& law, double time_s);

/// The 97.5 % quantile of Student's t for 1 or more degrees of freedom, to 0.2 %. Source: Abramowitz and
/// Stegun, Handbook of Mathematical Functions, 26.7.5; exact for 1 and 2.
double student_quantile(std::size_t degrees);

}  // namespace outrider
