// The robot of a guard task in simulation: a body that drives to waypoints, a gun, stores, and a detector of
// targets (sim/simulated_robot.hpp).
#pragma once

#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

/// In the yard of the problem, which with its survey must outlive the robot. All errors are drawn from named
/// streams of the seed: arrival, gun, timing, survival, sight. A store that `levels` has less of than it
/// holds is not full.
SimulatedRobot simulated_guard(const GuardProblem& problem, const FiringMap& firing_map, std::uint64_t seed,
                               TargetSimParams targets = {}, const StoreLevels& levels = {});

}  // namespace outrider
