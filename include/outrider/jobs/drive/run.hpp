// A whole drive, simulated: what the robot does, what it believes, and how far the truth is from it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "outrider/control/calibrate.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/jobs/drive/mission.hpp"
#include "outrider/sim/drive_sim_params.hpp"

namespace outrider {

/// Drives the task on a simulated robot and reports. `rendered`: images are rendered and the tags detected in
/// them (sim/tag_camera.hpp); otherwise sightings come from a model (sim/tag_model.hpp). status is "done"
/// when every waypoint was reached and nothing touched. A pure function of its arguments, the observer left
/// out. `progress` is told the part of the stops that is reached. Metrics:
///   driven_m, ideal_m      by the true middle of the robot; along straight legs through the waypoints
///   turned_rad, ideal_rad  the same of the heading
///   tag_fraction           images, of all taken, with a tag that told where the robot is
///   time_s                 until the last stop
///   clearance_m            least distance of the robot's disk to an obstacle or the edge, at most 1
/// and report.drive has the waypoints with their errors.
Report run_drive(const DriveTask& task, const DriveSimParams& params, bool rendered, std::uint64_t seed,
                 const RunWatch& watch = {});

/// Runs to calibrate that robot from: each direction it can go in, `repeats` times for each of 5 times, from
/// rest to rest with a fresh battery, at the speeds of the task; the ends are measured with errors of
/// `sigma_m` and `sigma_rad`.
std::vector<CalibrationRun> record_runs(const DriveTask& task, const DriveSimParams& params, int repeats,
                                        double sigma_m, double sigma_rad, std::uint64_t seed);

}  // namespace outrider
