// ExplorerSimParams: what the wheels and the range finder of an exploring robot are like, and what they do
// wrong.
//
// The defaults are those of a TurtleBot3 burger. Source: ROBOTIS e-Manual, TurtleBot3 features, LDS-01.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// A laser that turns about the vertical; each scan is of one instant.
struct RangeFinderModel {
  std::int64_t beams = 360;  ///< equally far apart over the whole turn, the first ahead
  double rate_hz = 5.0;
  double least_m = 0.12;  ///< what is nearer gives no reading
  double most_m = 3.5;    ///< what is farther is not seen
  double noise_m = 0.01;  ///< of a range, standard deviation
  double missed = 0.0;    ///< part of the beams that give no reading
  double height_m = 0.18;
  Pose2 robot_T_laser;
};
std::vector<Option> describe(RangeFinderModel& laser);

/// Two driven wheels, whose turns the robot counts as its odometry: of each wheel the way, with two errors.
/// The feet of tables and the like are too low for the laser, and are driven over.
struct ExplorerWheels {
  double track_m = 0.16;      ///< between the wheels
  double climbs_m = 0.1;      ///< what rises less than this above the floor is driven over
  double scale_error = 0.01;  ///< relative, standard deviation; drawn once
  double noise_m = 0.002;     ///< standard deviation after 1 m; grows with the root of the way
};
std::vector<Option> describe(ExplorerWheels& wheels);

struct ExplorerSimParams {
  RangeFinderModel laser;
  ExplorerWheels wheels;
};

}  // namespace outrider
