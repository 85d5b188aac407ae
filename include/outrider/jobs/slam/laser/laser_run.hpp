// run_laser_log() maps a laser log with LaserSlam, measures the time and compares the track with a reference.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/io/log/laser_source.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

/// A mapped log.
struct LaserRun {
  LaserSlam slam;
  std::size_t steps = 0;         ///< number of mapped steps
  bool stopped = false;          ///< the rest of the log was skipped on request
  bool trusts_odometry = false;  ///< no scan was matched, because the odometry is given as right
  std::size_t matched = 0;       ///< steps whose scan was matched
  std::size_t lost = 0;          ///< steps at which the robot was lost
  std::size_t repeated = 0;      ///< steps whose scan only repeats ranges, as of a frozen laser
  double time_s = 0.0;           ///< total time by the given clock
  double max_step_s = 0.0;       ///< longest step by the given clock
  /// Time from the first scan to the last; nothing if the clock of the log cannot be believed.
  std::optional<double> log_s;
  std::optional<double> mean_error_m;  ///< mean distance of the poses from the aligned reference
  std::optional<double> rms_error_m;   ///< root mean square of that distance
  std::vector<Vec2> reference;         ///< positions, aligned to the track by a rigid motion of least squares
};

/// Callbacks during mapping. Their time is not counted.
struct LaserWatch {
  std::stop_token stop = {};                       ///< on request the rest of the log is skipped
  std::function<void(double)> progress = nullptr;  ///< receives the progress, 0 to 1
  /// Receives the state after a step, its number, what was observed, and what came of it.
  std::function<void(const LaserSlam&, std::size_t step, const Observation&, const LaserSlamStep&)> stepped =
      nullptr;
};

/// Maps the whole log, and holds one scan of it besides those that the map is made of. Times are differences
/// of `processor_s`, a clock of the caller in seconds, because the library reads no clock. Reading the log
/// does not count. Faults: those of LaserSlam and of the source; bad_input without a scan.
Outcome<LaserRun> run_laser_log(LaserSource& source, const LaserSlamOptions& options, const LaserWatch& watch,
                                const std::function<double()>& processor_s);

/// Maps a log in memory, and compares the track with its reference.
Outcome<LaserRun> run_laser_log(const LaserLog& log, const LaserSlamOptions& options, const LaserWatch& watch,
                                const std::function<double()>& processor_s);

}  // namespace outrider
