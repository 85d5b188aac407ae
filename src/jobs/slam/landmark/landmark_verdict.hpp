// Judges whether a map of landmarks can be believed.
#pragma once

#include <vector>

#include "outrider/jobs/slam/landmark/landmark_mission.hpp"
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"
#include "outrider/slam/graph/systematic_errors.hpp"

namespace outrider {

/// Returns the cost for each degree of freedom: about 1 if the noise is as the options say; NaN if unknown.
double chi2_per_dof(const LandmarkSlam& slam);

/// Sets the status and the reason of the report: "done" if the robot was never lost, few sightings were
/// refused and those of two landmarks never so often that they were given up, the size of the map is not in
/// doubt, errors are about as large as the noise options say and, without ids, no landmark was moved farther
/// than the filter allows; else "doubtful". Adds what was counted to its metrics and the landmarks in doubt
/// to its tables, and to the log as events at its end. `times_s` are the times of the steps in the run.
void judge_landmarks(Report& report, Log& log, const LandmarkSlamOptions& options, const LandmarkMission& run,
                     const SystematicErrors& size, const std::vector<double>& times_s);

}  // namespace outrider
