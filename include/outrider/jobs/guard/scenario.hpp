// The scenario of a guard mission: every setting under the name it has in files and flags.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/jobs/guard/scout.hpp"
#include "outrider/jobs/guard/wander.hpp"
#include "outrider/sim/explorer_sim_params.hpp"

namespace outrider {

/// The decision problem as PDDL 2.1, in place of a mission.
struct PddlOptions {
  bool write = false;         ///< write it, and our plan
  std::int64_t stops = 8;     ///< places beside those of our plan that it offers
  std::string validate;       ///< path of a plan to judge; empty: none
  double tolerance_s = 1e-3;  ///< by which times of that plan may be off

  [[nodiscard]] bool any() const { return write || !validate.empty(); }
};
std::vector<Option> describe(PddlOptions& options);

struct GuardScenario {
  std::string world;                ///< path of an SDF file
  std::string terrain;              ///< path of a height field (terrain.hpp); empty: the ground of the world
  std::string terrain_size;         ///< of an image: length, width, height in m
  std::string terrain_position;     ///< of its middle, at black
  std::string moved;                ///< of the world: name=x,y,turn; ... (world_changes.hpp)
  std::string removed;              ///< of the world: name; ...
  std::string targets;              ///< path of a list of targets
  std::string start = "0,-9.5,90";  ///< x, y in m, heading in degrees
  std::string bounds;               ///< low x, low y, high x, high y; empty: the box of the walls
  std::int64_t seed = 1;
  std::string sim = "kinematic";  ///< or "physics": what carries the plan out
  GuardProblem problem;           ///< robot, gun and errors; world and targets once loaded
  GuardOptions options;
  ArrivalOptions arrivals;
  std::vector<Intruder> intruders;  ///< of `arrivals`, once loaded; none in a still yard
  WanderOptions wander;
  std::vector<double> preferences;  ///< of `wander`, once loaded
  std::vector<Track> history;       ///< of `wander`, once loaded
  ScoutOptions scout;
  ExplorerSimParams sensors;  ///< of a robot that scouts
  bool regions = false;       ///< draw firing_regions.svg
  PddlOptions pddl;
};

/// Top-level keys first, then the sections robot, gun, air, errors, supplies, plan, arrivals, wander,
/// scout, laser and wheels.
std::vector<OptionGroup> describe(GuardScenario& scenario);

/// Reads the world and the targets into `scenario.problem`; returns what was repaired on the way.
Outcome<std::vector<std::string>> load_problem(GuardScenario& scenario);

}  // namespace outrider
