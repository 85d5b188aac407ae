// A lower bound on the time of a guard mission that holds for every choice of places, ways and order.
//
// It holds for all missions that hit each target from the centre of a cell of its firing region, by any
// shot that the gun can fire, and that drive between these centres anywhere on free ground. Not counted
// are turning, aiming, and halting at the bends of a way.
//
// For a set of targets, let the value of a cell be the least time in which a robot that stands there hits
// them all. It is the least of two choices: hit one from here, then the rest; or drive to another cell and
// hit one from there. So the values of a set follow from those of the sets that lack one of it, by one
// search from many sources over the ground (Held and Karp, 1962, with fields for places). Drives are as
// long as the shortest chains of moves on the lattice of cells, which are never above the shortest way
// (lattice.hpp), and take the time from rest to rest. Flights take the least time in which a ball of full
// speed can touch the target, whatever stands between; in air, in which that would be hard to bound, what
// crossing the gap at full speed takes.
//
// Some targets are treated so; the others add their least flights. They are chosen one by one: the one for
// which the mission that attains the bound so far would have to do most (Righini and Salani, Networks
// 51(3), 2008).
#pragma once

#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/firing_map.hpp"

namespace outrider {

/// The bound for hitting `targets`, whose regions are not empty, s; 0 without any. At most 8 of them are
/// treated together, with `options.prove` 13, and fewer where 2^chosen fields of 2 bytes a cell would need
/// more than half of the memory cap. The budget counts sets of targets; when it ends, the bound is that
/// of the targets chosen so far. Same input, same value, for any number of threads.
/// O(2^chosen x cells) time and memory.
double mission_bound(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const GuardOptions& options,
                     const Budget& budget);

}  // namespace outrider
