// The scenario of exploring an unknown world: every setting under the name it has in files and flags.
//
//   job: explore
//   world: office.sdf          # or a map_server .yaml, an image .pgm or .png, slices .csv
//   start: "1,1,90"            # x,y in m, heading in degrees
//   walls: "0,0,4,0 4,0,4,3"   # more walls: x1,y1,x2,y2
//   seed: 1
//
// describe() has the other keys.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/map/world_file.hpp"
#include "outrider/io/sdf/robot_file.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/sim/faults/explorer_sim_params.hpp"

namespace outrider {

/// The settings of the job.
struct ExploreScenario {
  ExploreWorldFiles world;      ///< files of the world
  std::string start = "0,0,0";  ///< x, y in m, heading in degrees
  RobotFileOptions robot_file;  ///< its link is that of the laser
  std::int64_t seed = 1;        ///< of the simulation
  bool perfect_pose = false;    ///< odometry without errors, and no SLAM
  ExplorerSimParams sim;        ///< errors of the simulated robot
  std::string blocked_place;    ///< x, y in m, of the post of sim.faults; empty: before the robot
  ExploreTask task;             ///< the other settings; load_explore() sets its start
};

/// Describes the options: the top-level keys, then the sections.
std::vector<OptionGroup> describe(ExploreScenario& scenario);

/// Everything that a run needs.
struct ExploreSetup {
  World world;
  ExploreTask task;
  ExplorerSimParams sim;
  std::vector<std::string> warnings;  ///< what was repaired or left out in the world
};

/// Reads the files and the texts. Faults: bad_input with the file and line, or the key.
Outcome<ExploreSetup> load_explore(const ExploreScenario& scenario);

}  // namespace outrider
