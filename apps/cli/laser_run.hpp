// A laser log through LaserSlam, timed and held against its reference.
#pragma once

#include <functional>

#include "outrider/io/carmen_log.hpp"
#include "outrider/slam/laser_slam.hpp"

namespace outrider::cli {

struct LaserRun {
  LaserSlam slam;
  std::size_t matched = 0;
  std::size_t lost = 0;
  double time_s = 0.0;  ///< of the processor
  double max_step_s = 0.0;
  double log_s = 0.0;                  ///< from the first scan to the last; 0 where times say nothing
  std::optional<double> mean_error_m;  ///< mean distance of the poses from the reference, once aligned
  std::optional<double> rms_error_m;   ///< and the root of the mean square
  std::vector<Vec2> reference;         ///< moved onto the track by the rigid motion of least squares
};

/// Who looks on. What they do is not in the times.
struct LaserWatch {
  std::function<void(double)> progress = nullptr;  ///< how much is done, from 0 to 1
  std::function<void(const LaserSlam&, std::size_t step, const LaserSlamStep&)> stepped = nullptr;
};

Outcome<LaserRun> run_laser_log(const LaserLog& log, const LaserSlamOptions& options,
                                const LaserWatch& watch);

}  // namespace outrider::cli
