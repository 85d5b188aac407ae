// Maps a laser log with LaserSlam, takes the time of it and compares the track with the reference of the log.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/io/carmen_log.hpp"
#include "outrider/slam/laser_slam.hpp"

namespace outrider {

struct LaserRun {
  LaserSlam slam;
  std::size_t steps = 0;  ///< of the log that were mapped; fewer where it was stopped
  std::size_t matched = 0;
  std::size_t lost = 0;
  double time_s = 0.0;  ///< of the clock given
  double max_step_s = 0.0;
  double log_s = 0.0;                  ///< from the first scan to the last; 0 where times say nothing
  std::optional<double> mean_error_m;  ///< mean distance of the poses from the reference, once aligned
  std::optional<double> rms_error_m;   ///< and the root of the mean square
  std::vector<Vec2> reference;         ///< moved onto the track by the rigid motion of least squares
};

/// Called while the log is mapped. What these functions do is not in the times.
struct LaserWatch {
  std::stop_token stop = {};                       ///< raised: the rest of the log is left out
  std::function<void(double)> progress = nullptr;  ///< how much is done, from 0 to 1
  std::function<void(const LaserSlam&, std::size_t step, const LaserSlamStep&)> stepped = nullptr;
};

/// Maps the whole log. The times are differences of `processor_s`, a clock of the caller (s): the library
/// reads none. Faults: those of LaserSlam.
Outcome<LaserRun> run_laser_log(const LaserLog& log, const LaserSlamOptions& options, const LaserWatch& watch,
                                const std::function<double()>& processor_s);

}  // namespace outrider
