// GuardScenario: all settings of a guard mission, under their names in scenario files and flags.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/sdf/robot_file.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/jobs/guard/run/scout.hpp"
#include "outrider/jobs/guard/yard/arrivals.hpp"
#include "outrider/jobs/guard/yard/wander.hpp"
#include "outrider/sim/faults/guard_sim_params.hpp"
#include "outrider/sim/navigation.hpp"

namespace outrider {

/// The settings of a guard mission.
struct GuardScenario {
  std::string world;         ///< path of an SDF file
  SdfOptions sdf;            ///< where it finds models
  std::string terrain;       ///< path of a height field (terrain.hpp); empty: the ground of the world
  std::string terrain_size;  ///< size of an image terrain: length, width, height in m
  std::string
      terrain_position;  ///< position of the centre of an image terrain, at the height of black pixels
  std::string moved;     ///< solids to move: name=x,y,turn; ... (world_changes.hpp)
  std::string removed;   ///< solids to remove: name; ...
  std::string targets;   ///< path of a list of targets
  std::string start = "0,-9.5,90";  ///< x, y in m, heading in degrees
  std::int64_t robots = 1;          ///< number of robots that share the targets
  std::string robot_starts;         ///< of the robots after the first: x,y,heading; ... (inputs.hpp)
  std::string bounds;               ///< low x, low y, high x, high y; empty: bounding box of the walls
  std::int64_t seed = 1;            ///< seed of all random numbers
  std::string sim = "kinematic";    ///< simulator: "kinematic", "navigator" or "physics"
  std::string things;               ///< boxes and posts that no map has (io/scenario/things.hpp)
  RobotFileOptions robot_file;      ///< no link
  GuardProblem problem;             ///< robot, gun and errors; world and targets are set by load_problem()
  std::vector<Pose2>
      other_starts;  ///< those of `robot_starts` when loaded; empty: chosen by starts_of_team()
  GuardOptions options;
  ArrivalOptions arrivals;
  std::vector<Intruder>
      intruders;  ///< made from `arrivals` when loaded; empty if all targets are there from the start
  WanderOptions wander;
  std::vector<double> preferences;  ///< weight of each target, from `wander` when loaded
  std::vector<Track> history;       ///< recorded tracks, from `wander` when loaded
  ScoutOptions scout;
  NavigationOptions navigation = default_navigation();  ///< laser and wheels serve an unknown yard, too
  GuardSimParams faults;      ///< faults of the robot, which the mission does not know
  std::string blocked_place;  ///< x, y in m, of the post of `faults`; empty: on the way of the robot
  bool regions = false;       ///< log from where each target can be hit

  /// Returns the options of a robot that knows where it is.
  static NavigationOptions default_navigation();
  /// Returns true if all targets are there from the start, stand still and leave when they are hit.
  [[nodiscard]] bool has_still_targets() const {
    return !arrivals.any() && !arrivals.may_survive() && !wander.any();
  }
};

/// Returns the options: top-level keys first, then the sections robot, gun, air, errors, supplies, plan,
/// faults, arrivals, wander, scout, laser, wheels, walk_ins, navigator, live_map and motion.
std::vector<OptionGroup> describe(GuardScenario& scenario);

/// Reads the world and the targets into `scenario.problem`. Returns one sentence for each repair to the
/// inputs.
Outcome<std::vector<std::string>> load_problem(GuardScenario& scenario);

}  // namespace outrider
