// The mapping of each kind of recording.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input.hpp"
#include "outrider/job/job.hpp"
#include "outrider/jobs/slam/job.hpp"

namespace outrider {

/// Map a recording. Each reports the numbers that docs/jobs/slam.md lists.
Status solve_graph(const SlamJob& job, GraphInput input, Run& run, const RunWatch& watch);
Status map_landmark_log(const SlamJob& job, LandmarkLog log, Run& run, const RunWatch& watch);
Status map_laser_log(const SlamJob& job, const LaserLog& log, Run& run, const RunWatch& watch);

using Metrics = std::vector<std::pair<std::string, double>>;

/// Returns the value, or NaN if there is none.
inline double known(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace outrider
