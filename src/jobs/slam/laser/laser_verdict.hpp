// Judges whether a map of laser scans can be believed.
#pragma once

#include <string>
#include <vector>

#include "outrider/jobs/slam/laser/laser_run.hpp"
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Sets the status and the reason of the report: "done" if the scans matched, each gap was bridged, no
/// two scans contradict each other, odometry or scans confirm each step of the path, the path leads through
/// no wall, and the laser is neither frozen nor biased; else "doubtful". Adds what was counted to its metrics
/// and the places to its tables, and to the log as events at its end. `times_s` are the times of the steps in
/// the run. A map of trusted odometry claims nothing that could be doubted.
void judge_mapping(Report& report, Log& log, const LaserRun& run, const std::vector<double>& times_s);

}  // namespace outrider
