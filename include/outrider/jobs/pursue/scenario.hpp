// The scenario of a pursuit: every setting under the name it has in files and flags.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/jobs/pursue/run.hpp"
#include "outrider/pursuit/catalog.hpp"

namespace outrider {

/// The settings of the job.
struct PursuitScenario {
  std::string map;                         ///< path of a pursuit map (io/map/pursuit_map.hpp)
  std::string clock = "virtual";           ///< virtual or wall
  std::string planner = "optimal";         ///< a name of the catalogue of pursuit planners
  std::int64_t known = -1;                 ///< seconds of the target's future that are known; -1: all
  std::string forecast = "last_velocity";  ///< name of the forecast for the unknown seconds
  std::int64_t pursuers = 1;               ///< number of robots
  std::string starts;     ///< cells of the robots after the first, "x,y x,y", as in the file; empty: placed
  double call_s = 1.5;    ///< duration of a call of the anytime search on the wall clock
  std::int64_t seed = 1;  ///< of what faults draw
  TeamFaults faults;      ///< the mission is not told
  std::string sim = "ideal";  ///< steps from cell to cell, or navigator: a robot on wheels that drives there
  PursuerOptions pursuer;     ///< this robot
  std::vector<ConfiguredPursuitPlanner> planners = configured_planners();  ///< in the order of the catalogue

  /// Returns all planners with their default options.
  static std::vector<ConfiguredPursuitPlanner> configured_planners();
};

/// Describes the options: the top-level keys, then a section for each planner that has options, under its
/// name, the section faults, and those of a robot on wheels.
std::vector<OptionGroup> describe(PursuitScenario& scenario);

/// Everything that a run needs.
struct PursuitTask {
  PursuitProblem problem;
  std::vector<Cell> robots;
  PursuitRules rules;
};

/// Returns the rules of the mission. Faults: bad_input for a planner or a forecast that does not exist.
Outcome<PursuitRules> rules_of(const PursuitScenario& scenario);

/// Reads the map and the names. Faults: bad_input with the file and line, or the key.
Outcome<PursuitTask> load_task(const PursuitScenario& scenario);

}  // namespace outrider
