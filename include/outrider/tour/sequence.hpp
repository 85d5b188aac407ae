// Sequence: the next stops and the hits at each, for targets that are there or arrive at known times.
//
// A beam search over sequences of hits. Among the sequences with the same number of hits, the search keeps
// the best few, at most one for each combination of targets hit, place and last hit. A sequence is ranked
// by the value of its objective if all remaining targets were hit at the time of its last hit. Turns, drives,
// aiming and services have the times of the tour model (problem.hpp). No target is served before it is in its
// place.
//
// Guarantees: the plan hits each pending target once, if each has a service at a stop with a drive. It is
// optimal if the beam never overflows, turns and aiming take no time, and all targets are in their places.
// The same input gives the same result, bit for bit. O(pending^2 * stops * beam). Source: Lowerre, The HARPY
// speech recognition system, 1976 (beam search); the objective is that of the travelling repairman, Afrati et
// al., 1986.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/tour/problem.hpp"

namespace outrider {

/// The quantity to minimise: the sum of the times of the hits, which is that of the times that intruders are
/// inside but for a constant, or the time of the last hit.
enum class ArrivalObjective { time_inside, makespan };

/// A target that is still to be hit.
struct PendingTarget {
  std::uint32_t goal = 0;  ///< its goal in the tour problem
  double settles_s = 0.0;  ///< earliest time of a shot
};

/// The state of the robot between two commands.
struct RobotState {
  double time_s = 0.0;
  double heading_rad = 0.0;
  double gun_yaw_rad = 0.0;  ///< relative to the body
  double gun_pitch_rad = 0.0;
  std::vector<Drive> drives;  ///< from here to each stop
};

/// A plan for the pending targets.
struct Sequence {
  std::vector<Visit> visits;  ///< stops with their hits, as indices in the list of pending targets
  double value = 0.0;         ///< the sum of the times of the hits, or the time of the last one, s
};

/// Returns the best sequence of the beam search for at most 64 pending targets. If one of them cannot be
/// hit, the sequence is empty and its value infinite.
Sequence best_sequence(const TourProblem& table, const std::vector<PendingTarget>& pending,
                       const RobotState& from, ArrivalObjective objective, std::size_t beam);

/// Returns the value of the given visits; infinite if they do not hit each pending target exactly once, or
/// if a service or a drive is missing.
double value_of(const TourProblem& table, const std::vector<PendingTarget>& pending, const RobotState& from,
                ArrivalObjective objective, const std::vector<Visit>& visits);

/// Returns the better of two sequences: that of the beam search, and the part of `tour` that hits the pending
/// targets. The tour is over the same stops, with the goals of the table. If `as_toured`, the part of the
/// tour is returned whenever it can be driven.
Sequence sequence_beside(const std::vector<Visit>& tour, const TourProblem& table,
                         const std::vector<PendingTarget>& pending, const RobotState& from,
                         ArrivalObjective objective, std::size_t beam, bool as_toured);

/// Returns the state of the robot after it has driven to a stop and hit the target `whom` from there. Its
/// time is infinite if that is impossible.
RobotState after_hit(const TourProblem& table, const PendingTarget& whom, const RobotState& from,
                     std::size_t stop);

}  // namespace outrider
