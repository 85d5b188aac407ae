// A lower bound on the time of a guard mission on the move that counts turns and halts.
//
// It holds for all missions of a robot that turns in place and drives straight from rest to rest, and that
// fires at each target while it is anywhere in a cell of its firing region, standing or driving, in any
// order. Aims and flights count nothing.
//
// A value is a time within which no mission can end from there (Held and Karp, 1962, with headings). There is
// one for each set of targets still to hit, and for a robot on a straight drive for each cone of headings and
// tile (heading_cone.hpp), for one at rest for each cone of its next straight drive and cell. The values are
// the largest numbers for which:
// - from a tile to the next ones ahead, a value falls by no more than the drive of that step takes;
// - a straight drive of length L >= v^2 / (2 a) takes L / v, and (sqrt(2) - 1/2) v / a or more besides to
// speed
//   up and slow down; shorter ones count as part of the rest between longer ones, and take sqrt(8) L / v or
//   more;
// - between two straight drives, the robot turns by the least angle between their cones or more;
// - where a target can be hit, the value is at most that without the target.
// Within a cell the robot may be anywhere, so each halt lets it move by up to two cells for nothing.
#pragma once

#include <stop_token>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "research/guard/heading_fields.hpp"

namespace outrider {

/// Cells that a bound may leave out, because no mission of at most `most_s` uses them.
struct HeadingLimits {
  double most_s = 0.0;
  std::vector<GridWindow>
      cells;  ///< by set of targets, a bit for each: where a robot may be that has these left to hit
};

/// False where the yard is so large that heading_bound() would be 0, and the limits need not be found.
bool heading_bound_possible(const GuardProblem& problem, const FiringMap& firing_map);

/// Returns the bound for hitting `targets`, s, or `limits.most_s` if it is not less. Returns 0 if
/// `memory_bytes` or the work allowed for one bound is too little, if the robot speeds up so fast that a halt
/// costs less than what is lost at it, or after a stop request. The value is the same for any number of
/// threads. O(cells of all windows) memory, and as much time for each bend of a mission.
double heading_bound(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const HeadingLimits& limits,
                     double memory_bytes, const std::stop_token& stop);

}  // namespace outrider
