// Sequence: where to stop next and whom to shoot from there, for those who are inside now.
//
// A beam search over sequences of hits. Of the sequences with the same number of hits the best few are
// kept, one for each set of intruders hit, place and last hit. A sequence is ranked by what its objective
// comes to if everybody left were hit at the time of the last hit. Turns, drives, aims and flights cost what
// the tour's model says (tour/problem.hpp); nobody is shot at before it is in its place.
//
// Guarantees: the plan hits each of those pending once, if each has a service at a stop with a drive; it
// is the best of all such plans if the beam never overflows, turns and aims take no time, and everybody is in
// its place. Same input, same bytes. O(pending^2 x stops x beam).
// Source: Lowerre, The HARPY speech recognition system, 1976 (beam search); the objective is that of the
// travelling repairman, Afrati et al., 1986.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

/// Someone to be hit.
struct PendingTarget {
  std::uint32_t goal = 0;  ///< of the table
  double settles_s = 0.0;  ///< not to be shot at before
};

/// The robot between two commands.
struct RobotState {
  double time_s = 0.0;
  double heading_rad = 0.0;
  double gun_yaw_rad = 0.0;  ///< relative to the body
  double gun_pitch_rad = 0.0;
  std::vector<Drive> drives;  ///< from here to each stop
};

/// A stop and those to be hit from there, as indices of the list of pending.
struct Sequence {
  std::vector<Visit> visits;
  double value = 0.0;  ///< the sum of the times of the hits, or the time of the last one, s
};

/// At most 64 pending. Empty, with an infinite value, when someone of them cannot be hit.
Sequence best_sequence(const TourProblem& table, const std::vector<PendingTarget>& pending,
                       const RobotState& from, ArrivalObjective objective, std::size_t beam);

/// The value of given visits, for comparison; infinite when they do not hit each of those pending once, or a
/// service or a drive is missing.
double value_of(const TourProblem& table, const std::vector<PendingTarget>& pending, const RobotState& from,
                ArrivalObjective objective, const std::vector<Visit>& visits);

/// The better of the beam's sequence and the part of a tour over the same stops, its goals those of the
/// table, that is about those pending; the latter whenever it can be driven if `as_toured`.
Sequence sequence_beside(const std::vector<Visit>& tour, const TourProblem& table,
                         const std::vector<PendingTarget>& pending, const RobotState& from,
                         ArrivalObjective objective, std::size_t beam, bool as_toured);

/// The robot once it has gone to a stop and hit someone from there; its time is infinite when it cannot.
RobotState after_hit(const TourProblem& table, const PendingTarget& whom, const RobotState& from,
                     std::size_t stop);

}  // namespace outrider
