// The clairvoyant lower bound: what no policy can do better, even if it knew every arrival beforehand.
#pragma once

#include "outrider/jobs/guard/arrivals.hpp"

namespace outrider {

struct ArrivalBound {
  double time_inside_s = 0.0;  ///< summed over the intruders that can be hit
  double makespan_s = 0.0;     ///< of the last hit, from the start
};

/// For every run in which each intruder whose place has a firing region is hit, or stays until the end,
/// and every shot is fired from within `errors.position_m` of a cell of the region, within the errors.
///
/// An intruder j is a job on one machine, the robot. It is released when it is in its place and the robot
/// can have got from the start to the nearest cell of its region (in a straight line, less the error); it
/// takes at least p_j, the time in which the fastest ball crosses the narrowest gap. Balls fly one at a time.
/// Then the least sum of completion times of jobs that may be interrupted is a bound; serving the job with
/// the shortest rest first attains it (Schrage, Operations Research 16(3), 1968). For the makespan:
/// the largest over k of r_k + the work released at r_k or later. Drives between places, turns and aims
/// are not counted. O(intruders x cells + intruders^2).
ArrivalBound arrival_bound(const ArrivalYard& watch);

/// A job of the relaxation.
struct ReleasedWork {
  double release_s = 0.0;
  double work_s = 0.0;
};
/// The least sum of completion times when jobs may be interrupted. O(jobs^2).
double least_completion_sum(std::vector<ReleasedWork> jobs);

}  // namespace outrider
