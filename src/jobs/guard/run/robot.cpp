#include "outrider/jobs/guard/run/robot.hpp"

#include <utility>

namespace outrider {

SimulatedRobot simulated_guard(const GuardProblem& problem, const FiringMap& firing_map, Log& log,
                               std::uint64_t seed, TargetSimParams targets, const StoreLevels& levels,
                               const GuardSimParams& faults) {
  const Rng rng(seed);
  const ExecutionErrors errors = true_errors(problem.errors, faults);
  SimulatedDevices devices;
  devices.gun.emplace(GunScene{firing_map.rules, firing_map.spaces, problem.targets}, errors,
                      rng.child("gun"), rng.child("timing"), faults.gun);
  if (problem.supplies.any()) devices.stores.emplace(problem.supplies, levels);
  devices.targets.emplace(problem.targets, std::move(targets), seed);
  return SimulatedRobot(log,
                        WaypointBody(problem.robot, {firing_map.ground, firing_map.rules}, problem.start,
                                     errors, rng.child("arrival"), faults.way),
                        std::move(devices));
}

RigidScene rigid_scene(const GuardProblem& problem) {
  return {problem.world, problem.targets, problem.targets_block,
          problem.robot, problem.start,   problem.gun.ball_radius_m};
}

Outcome<SimulatedRobot> rigid_guard(const GuardProblem& problem, const FiringMap& firing_map, Log& log,
                                    std::uint64_t seed) {
  auto world = make_rigid_world(rigid_scene(problem));
  if (!world) return pass_on(world);
  const Rng rng(seed);
  SimulatedDevices devices;
  devices.gun.emplace(GunScene{firing_map.rules, firing_map.spaces, problem.targets}, problem.errors,
                      rng.child("gun"), rng.child("timing"));
  return SimulatedRobot(
      log,
      RigidBody(std::move(*world), rigid_scene(problem), {firing_map.ground, firing_map.rules},
                problem.errors, rng.child("arrival")),
      std::move(devices));
}

}  // namespace outrider
