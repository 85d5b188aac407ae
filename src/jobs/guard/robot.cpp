#include "outrider/jobs/guard/robot.hpp"

#include <utility>

namespace outrider {

SimulatedRobot simulated_guard(const GuardProblem& problem, const FiringMap& firing_map, Log& log,
                               std::uint64_t seed, TargetSimParams targets, const StoreLevels& levels) {
  const Rng rng(seed);
  SimulatedDevices devices;
  devices.gun.emplace(GunScene{firing_map.rules, firing_map.spaces, problem.targets}, problem.errors,
                      rng.child("gun"), rng.child("timing"));
  if (problem.supplies.any()) devices.stores.emplace(problem.supplies, levels);
  devices.targets.emplace(problem.targets, std::move(targets), seed);
  return SimulatedRobot(log,
                        WaypointBody(problem.robot, {firing_map.ground, firing_map.rules}, problem.start,
                                     problem.errors, rng.child("arrival")),
                        std::move(devices));
}

}  // namespace outrider
