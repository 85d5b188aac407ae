#include "outrider/jobs/guard/run/robot.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "outrider/io/scenario/things.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double least_within_m = 0.02;  // of a place, where a robot on wheels arrives
constexpr double cell_m = 0.05;
constexpr std::size_t most_cells = 4'000'000;

/// Returns the ground as a map of cells, occupied where an obstacle or the edge is within half a cell of the
/// middle.
KnownMap map_of(const CollisionMap& ground) {
  double resolution_m = cell_m;
  GridFrame frame = covering(ground.bounds(), resolution_m);
  for (; frame.size() > most_cells; frame = covering(ground.bounds(), resolution_m)) resolution_m *= 1.25;
  KnownMap map{Grid<std::uint8_t>(frame, free_cell)};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (ground.clearance(frame.centre(frame.cell(i)), resolution_m) < 0.5 * resolution_m)
      map.occupancy.cells[i] = occupied_cell;
  }
  return map;
}

/// Returns the gun, the stores and the detector.
SimulatedDevices devices_of(const GuardProblem& problem, const GunScene& scene, const Rng& rng,
                            std::uint64_t seed, TargetSimParams targets, const StoreLevels& levels,
                            const GuardSimParams& faults) {
  SimulatedDevices devices;
  devices.gun.emplace(scene, true_errors(problem.errors, faults), rng.child("gun"), rng.child("timing"),
                      faults.gun);
  if (problem.supplies.any()) devices.stores.emplace(problem.supplies, levels);
  devices.targets.emplace(problem.targets, std::move(targets), seed);
  return devices;
}

/// Returns what goes wrong with the wheels, and who walks there, with what holds the robot up or carries it.
ExplorerFaults with_hindrance(ExplorerFaults faults, const WayFaults& way) {
  faults.kidnapping = way.kidnapping;
  faults.stuck_from_s = way.stuck_from_s;
  faults.stuck_for_s = way.stuck_for_s;
  if (way.blocked_at_s > faults.walk_ins.blocked_at_s) return faults;
  faults.walk_ins.blocked_at_s = way.blocked_at_s;
  faults.walk_ins.blocked_for_s = way.blocked_for_s;
  faults.walk_ins.blocked_radius_m = way.blocked_radius_m;
  faults.walk_ins.blocked_place = way.blocked_place;
  return faults;
}

}  // namespace

SimulatedRobot simulated_guard(const GuardProblem& problem, const FiringMap& firing_map, Log& log,
                               std::uint64_t seed, TargetSimParams targets, const StoreLevels& levels,
                               const GuardSimParams& faults) {
  const Rng rng(seed);
  const GunScene scene{firing_map.rules, firing_map.spaces, problem.targets};
  return SimulatedRobot(log,
                        WaypointBody(problem.robot, {firing_map.ground, firing_map.rules}, problem.start,
                                     true_errors(problem.errors, faults), rng.child("arrival"), faults.way),
                        devices_of(problem, scene, rng, seed, std::move(targets), levels, faults));
}

Outcome<NavigatedYard> navigated_yard(const GuardProblem& truth, const std::string& things) {
  NavigatedYard yard{truth, {}};
  const RobotModel& robot = truth.robot;
  if (auto ok = add_things(things, robot.height_m, yard.problem.world); !ok) return pass_on(ok);
  yard.spaces = flight_spaces(yard.problem);
  const Vec2 start = truth.start.position;
  if (CollisionMap::of(yard.problem.world, robot.height_m).segment_free({start, start}, robot.radius_m))
    return yard;
  return bad_input(fmt::format("they leave the robot no room where it starts, at ({:.2f}, {:.2f}); move one, "
                               "or give another start",
                               start.x, start.y),
                   "things");
}

Outcome<SimulatedRobot> navigated_guard(const NavigatedYard& yard, const FiringMap& known,
                                        const NavigationOptions& navigation, Log& log, std::uint64_t seed,
                                        TargetSimParams targets, const StoreLevels& levels,
                                        const GuardSimParams& faults) {
  const GuardProblem& problem = yard.problem;
  const Footprint footprint = Footprint::disk(problem.robot.radius_m);
  NavigatorSetup setup = setup_of(navigation, problem.robot, footprint);
  setup.known = map_of(known.ground);
  auto navigator = Navigator::make(std::move(setup), problem.start);
  if (!navigator) return pass_on(navigator);
  const Rng rng(seed);
  ExplorerSimParams devices = devices_of(navigation, footprint);
  devices.faults = with_hindrance(devices.faults, faults.way);
  const GunScene scene{known.rules, yard.spaces, problem.targets};
  return SimulatedRobot(log,
                        NavigatedBody(std::make_unique<const World>(driving_world(problem)), problem.start,
                                      problem.robot, devices, seed, std::move(*navigator),
                                      std::max(least_within_m, problem.errors.position_m)),
                        devices_of(problem, scene, rng, seed, std::move(targets), levels, faults));
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
