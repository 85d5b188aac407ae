// The clairvoyant lower bound for arriving intruders: no policy can be better, not even one that knows every
// arrival in advance.
#pragma once

#include "outrider/jobs/guard/yard/arrivals.hpp"

namespace outrider {

/// Lower bounds for both objectives.
struct ArrivalBound {
  double time_inside_s = 0.0;  ///< time inside, summed over the intruders that can be hit
  double makespan_s = 0.0;     ///< time of the last hit, from the start
};

/// Returns the bounds. They hold for every run in which each intruder whose place has a firing region is hit
/// or stays until the end, and every shot is fired from within `errors.position_m` of a cell of the region,
/// within the errors. `on_the_move`: also for runs with shots from cells of the region during drives, and
/// with any number of balls in the air.
///
/// The relaxation is a scheduling problem: each intruder j is a job, and the robot is the one machine. Job j
/// is released at r_j, when the intruder is in its place and the robot can have reached the nearest cell of
/// its region (in a straight line, less the error). It takes at least p_j, the time in which the fastest ball
/// crosses the narrowest gap. From rest, only one ball flies at a time. The bound on the time inside is the
/// least sum of completion times with preemption; the rule of the shortest remaining processing time attains
/// it (Schrage, Operations Research 16(3), 1968). The bound on the makespan is the maximum over k of r_k +
/// the work released at r_k or later. On the move, jobs do not wait for each other, and the robot need not
/// stop at the nearest cell. Drives between places, turns and aiming are not counted. O(intruders * cells +
/// intruders^2).
ArrivalBound arrival_bound(const ArrivalYard& watch, bool on_the_move);

/// A job of the relaxation.
struct ReleasedWork {
  double release_s = 0.0;  ///< time from which the job may be processed
  double work_s = 0.0;     ///< processing time
};
/// Returns the least sum of completion times with preemption. O(jobs^2).
double least_completion_sum(std::vector<ReleasedWork> jobs);

}  // namespace outrider
