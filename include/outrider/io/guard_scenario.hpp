// The scenario of a guard mission: every setting under the name it has in files and flags.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/guard/arrivals.hpp"
#include "outrider/guard/problem.hpp"

namespace outrider {

struct GuardScenario {
  std::string job = "guard";
  std::string world;                ///< path of an SDF file
  std::string targets;              ///< path of a list of targets
  std::string start = "0,-9.5,90";  ///< x, y in m, heading in degrees
  std::string bounds;               ///< low x, low y, high x, high y; empty: the box of the walls
  std::int64_t seed = 1;
  GuardProblem problem;  ///< robot, gun and errors; world and targets once loaded
  GuardOptions options;
  ArrivalOptions arrivals;
  std::vector<Intruder> intruders;  ///< of `arrivals`, once loaded; none in a still yard
};

/// Top-level keys first, then the sections robot, gun, errors, plan and arrivals.
std::vector<OptionGroup> describe(GuardScenario& scenario);

/// Makes the paths in a scenario, which are relative to its file, relative to here.
void resolve_paths(GuardScenario& scenario, const std::string& scenario_path);

/// Reads the world and the targets into `scenario.problem`; returns what was repaired on the way.
Outcome<std::vector<std::string>> load_problem(GuardScenario& scenario);

/// Numbers between commas, exactly `count` of them; the fault names `where`.
Outcome<std::vector<double>> parse_numbers(const std::string& text, std::size_t count,
                                           const std::string& where, const std::string& form);

}  // namespace outrider
