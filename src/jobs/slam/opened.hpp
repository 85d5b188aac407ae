// Functions shared by all kinds of input of the job slam: the mapping of each kind, and the start of its
// report.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input.hpp"
#include "outrider/job/job.hpp"
#include "outrider/jobs/slam/job.hpp"

namespace outrider {

/// Map a recording. Each reports the numbers that docs/jobs/slam.md lists.
Outcome<Run> solve_graph(const SlamJob& job, GraphInput input, const RunWatch& watch);
Outcome<Run> map_landmark_log(const SlamJob& job, LandmarkLog log, const RunWatch& watch);
Outcome<Run> map_laser_log(const SlamJob& job, const LaserLog& log, const RunWatch& watch);

/// Returns the initial report of the job.
Report opened(const SlamScenario& scenario);

using Metrics = std::vector<std::pair<std::string, double>>;

/// Returns the value, or NaN if there is none.
double known(const std::optional<double>& value);

/// Inserts the metrics before those of the report, and computes its bounds.
void conclude(Report& report, Metrics metrics);

}  // namespace outrider
