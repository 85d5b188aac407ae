// A lower bound on the time of a guard mission that holds for every choice of stops, paths and order.
//
// It holds for all missions that hit each target from the centre of a cell of its firing region, with any
// shot that the gun can fire, and that drive between these centres anywhere on free ground. Turning, aiming
// and stopping at the bends of a path are not counted.
//
// On the move (GuardOptions::shoot_on_the_move) it holds for all missions that fire at each target while the
// robot is anywhere in a cell of its firing region, standing or driving. Flights count nothing then, and a
// drive of length d takes d / v; the robot speeds up once. For each target that takes part, the way to the
// centre of a cell and back is taken off. A bound that counts turns and halts, too, is in research/
// (research/guard/heading_plan.hpp).
//
// The bound is a dynamic programme over sets of targets (Held and Karp, 1962). For a set, the value of a cell
// is the least time in which a robot that stands there can hit all targets of the set. There are two choices:
// hit one target from here and then the others, or drive to another cell first. So the values of a set follow
// from those of its subsets with one target less, by one multi-source search over the ground. The length of a
// drive is that of the shortest chain of moves on the lattice of cells, which is never longer than the
// shortest path (path/grid/drive_lattice.hpp); its time is that of a drive from rest to rest. A flight takes
// the least time in which a ball of full speed can touch the target, with obstacles ignored. In air that time
// would be hard to bound, so the time to cross the gap at full speed is used.
//
// Only some targets take part in the dynamic programme; each of the others adds its shortest flight. The
// targets that take part are added one by one: next comes the target that would cost most extra in the
// mission that attains the present bound (Righini and Salani, Networks 51(3), 2008).
//
// The clairvoyant lower bound for arriving intruders: no policy can be better, not even one that knows every
// arrival in advance.
#pragma once

#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/yard/arrivals.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// Returns the bound for hitting `targets`, s; 0 if there are none. Their regions must not be empty. At most
/// 8 targets take part in the dynamic programme (13 with `options.prove`), and fewer if 2^chosen fields of 2
/// bytes per cell would need more than half of the memory limit. The budget counts sets of targets; when it
/// is used up, the result is the bound for the targets chosen so far. The value is the same for any number of
/// threads. O(2^chosen * cells) time and memory.
double mission_bound(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const GuardOptions& options,
                     const Budget& budget);

/// Returns a bound on the makespan of a team of robots with these starts, s: no team that hits the same
/// targets, as above, has its last hit sooner. Each chosen target belongs to one robot. So the bound is the
/// least, over all partitions of the chosen targets, of the largest value of a robot from its own start. At
/// most 8 targets take part; turns and halts at bends are never counted. O(robots * 3^chosen) in addition.
double team_bound(const GuardProblem& problem, const FiringMap& firing_map,
                  const std::vector<std::size_t>& targets, const std::vector<Pose2>& starts,
                  const GuardOptions& options, const Budget& budget);

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
