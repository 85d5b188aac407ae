// ExplorerSimParams: properties and errors of the wheels and the range finder of an exploring robot.
//
// The defaults are those of a TurtleBot3 burger. Source: ROBOTIS e-Manual, TurtleBot3 features, LDS-01.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// A laser scanner that rotates about a vertical axis. All beams of a scan are measured at the same instant.
struct RangeFinderModel {
  std::int64_t beams = 360;  ///< number of beams per scan, evenly spaced over 360 degrees, the first ahead
  double rate_hz = 5.0;      ///< scans per second
  double least_m = 0.12;     ///< minimum range; a nearer obstacle gives no reading
  double most_m = 3.5;       ///< maximum range; a farther obstacle is not seen
  double noise_m = 0.01;     ///< standard deviation of a range
  double missed = 0.0;       ///< fraction of the beams that give no reading
  double height_m = 0.18;    ///< height of the scan plane above the floor
  Pose2 robot_T_laser;       ///< mounting pose
};
std::vector<Option> describe(RangeFinderModel& laser);

/// Two driven wheels with encoders. The odometry measures the distance that each wheel rolls, with a scale
/// error and noise.
struct ExplorerWheels {
  double track_m = 0.16;  ///< distance between the wheels
  /// The robot drives over anything lower than this, such as the feet of tables, which are below the laser.
  double climbs_m = 0.1;
  double scale_error = 0.01;  ///< standard deviation of the relative scale error, drawn once per wheel
  double noise_m = 0.002;     ///< standard deviation after 1 m; grows with the square root of the distance
};
std::vector<Option> describe(ExplorerWheels& wheels);

/// The simulated devices of an exploring robot.
struct ExplorerSimParams {
  RangeFinderModel laser;
  ExplorerWheels wheels;
};

}  // namespace outrider
