// The simulated robot of a guard task: a body that drives, a gun, stores, and a target detector
// (sim/simulated_robot.hpp).
#pragma once

#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/sim/navigation.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

/// Makes the robot. The problem, the firing map and the log must outlive it. All errors are drawn from named
/// random streams of the seed: arrival, gun, timing, survival, sight. The stores begin at `levels`, at most
/// full. The problem does not know of the faults.
SimulatedRobot simulated_guard(const GuardProblem& problem, const FiringMap& firing_map, Log& log,
                               std::uint64_t seed, TargetSimParams targets = {},
                               const StoreLevels& levels = {}, const GuardSimParams& faults = {});

/// The yard of a robot that its navigator drives, with the things that no map has.
struct NavigatedYard {
  GuardProblem problem;
  std::vector<FlightSpace> spaces;  ///< the obstacles of flights
};
/// Faults: bad_input for things that are none, or that leave the robot no room where it starts.
Outcome<NavigatedYard> navigated_yard(const GuardProblem& truth, const std::string& things);

/// Makes a robot that its navigator drives, by the map `known.ground`. What is given must outlive it. Faults:
/// those of Navigator::make().
Outcome<SimulatedRobot> navigated_guard(const NavigatedYard& yard, const FiringMap& known,
                                        const NavigationOptions& navigation, Log& log, std::uint64_t seed,
                                        TargetSimParams targets, const StoreLevels& levels,
                                        const GuardSimParams& faults);

/// Returns the yard and the robot of a problem as rigid bodies.
RigidScene rigid_scene(const GuardProblem& problem);

/// Makes the robot among rigid bodies (sim/rigid/rigid_body.hpp), with the same random streams arrival, gun
/// and timing. The problem, the firing map and the log must outlive it. Faults: those of make_rigid_world().
Outcome<SimulatedRobot> rigid_guard(const GuardProblem& problem, const FiringMap& firing_map, Log& log,
                                    std::uint64_t seed);

}  // namespace outrider
