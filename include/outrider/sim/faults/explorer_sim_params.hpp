// ExplorerSimParams: properties and errors of the wheels and the range finder of an exploring robot.
//
// The defaults are those of a TurtleBot3 burger. Source: ROBOTIS e-Manual, TurtleBot3 features, LDS-01.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/planner_outage.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/footprint.hpp"
#include "outrider/motion/wheel_faults.hpp"
#include "outrider/sim/faults/clock_faults.hpp"
#include "outrider/sim/faults/kidnapping.hpp"
#include "outrider/sim/faults/walk_ins.hpp"

namespace outrider {

/// A laser scanner that rotates about a vertical axis. All beams of a scan are measured at the same instant.
struct RangeFinderModel {
  std::int64_t beams = 360;    ///< number of beams per scan, evenly spaced over 360 degrees, the first ahead
  double view_rad = 2.0 * pi;  ///< angle about ahead that it sees; the other beams give no reading
  double rate_hz = 5.0;        ///< scans per second
  double least_m = 0.12;       ///< minimum range; a nearer obstacle gives no reading
  double most_m = 3.5;         ///< maximum range; a farther obstacle is not seen
  double noise_m = 0.01;       ///< standard deviation of a range
  double missed = 0.0;         ///< fraction of the beams that give no reading
  double height_m = 0.18;      ///< height of the scan plane above the floor
  Pose2 robot_T_laser;         ///< mounting pose
};
std::vector<Option> describe(RangeFinderModel& laser);
/// Refuses a minimum range that is not below the maximum. Fault: bad_input at laser.least.
Status check(const RangeFinderModel& laser);

/// Two driven wheels with encoders. The odometry measures the distance that each wheel rolls, with a scale
/// error and noise.
struct ExplorerWheels {
  double track_m = 0.16;  ///< distance between the wheels
  /// The robot drives over anything lower than this, such as the feet of tables, which are below the laser.
  double climbs_m = 0.1;
  double scale_error = 0.01;  ///< standard deviation of the relative scale error, drawn once per wheel
  double noise_m = 0.002;     ///< standard deviation after 1 m; grows with the square root of the distance
  bool exact = false;  ///< the odometry is the true motion, as of a robot that is measured from outside
};
std::vector<Option> describe(ExplorerWheels& wheels);

/// Faults of the range finder and the wheels. The robot is not told of them.
struct ExplorerFaults {
  double blind_from_s = 1e9;   ///< from then on no scan comes
  double blind_for_s = 1e9;    ///< for how long
  double bias_m = 0.0;         ///< added to every range
  double outliers = 0.0;       ///< fraction of the beams that give any range between minimum and maximum
  double latency_s = 0.0;      ///< a scan arrives so long after it was measured
  double frozen_from_s = 1e9;  ///< from then on every scan repeats the last ranges
  double slip = 0.0;           ///< fraction of the rolling of both wheels that does not move the robot
  double stuck_from_s = 1e9;   ///< from then on the left wheel does not turn
  double stuck_for_s = 1e9;    ///< for how long
  ClockFaults clock;           ///< none by default
  WalkInOptions walk_ins;      ///< nobody by default
  PlannerOutage planner;       ///< none by default
  Kidnapping kidnapping;       ///< shorter than asked for if the robot would stand in something

  /// Returns true if any fault was asked for, of those that describe() lists, or a walk-in.
  [[nodiscard]] bool any() const;
  [[nodiscard]] bool blind(double time_s) const {
    return time_s >= blind_from_s && time_s < blind_from_s + blind_for_s;
  }
  [[nodiscard]] bool stuck(double time_s) const {
    return time_s >= stuck_from_s && time_s < stuck_from_s + stuck_for_s;
  }
};
/// Returns the options of all members but the walk-ins and the planner.
std::vector<Option> describe(ExplorerFaults& faults);

/// The simulated devices of an exploring robot.
struct ExplorerSimParams {
  RangeFinderModel laser;
  ExplorerWheels wheels;
  ExplorerFaults faults = {};
  LinkFaults link = {};                     ///< of the link on which scans travel to the robot's computer
  std::optional<Footprint> footprint = {};  ///< of the body; none: the disk of the robot model
};

}  // namespace outrider
