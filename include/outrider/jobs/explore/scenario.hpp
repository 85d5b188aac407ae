// The scenario of exploring an unknown world: every setting under the name it has in files and flags.
//
//   job: explore
//   world: office.sdf          # or a map_server .yaml, an image .pgm or .png, slices .csv
//   start: "1,1,90"            # x,y in m, heading in degrees
//   walls: "0,0,4,0 4,0,4,3"   # more walls: x1,y1,x2,y2
//   seed: 1
//
// The other keys stand in describe().
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/explore_world.hpp"
#include "outrider/jobs/explore/task.hpp"
#include "outrider/sim/explorer_sim_params.hpp"

namespace outrider {

struct ExploreScenario {
  ExploreWorldFiles world;
  std::string start = "0,0,0";  ///< x, y in m, heading in degrees
  std::int64_t seed = 1;
  bool perfect_pose = false;  ///< wheels that count right and are believed: no SLAM
  ExplorerSimParams sim;
  ExploreTask task;  ///< the rest of what is set; its start comes from the text
};

/// The top-level keys first, then the sections.
std::vector<OptionGroup> describe(ExploreScenario& scenario);

/// All that a run is made of.
struct ExploreSetup {
  World world;
  ExploreTask task;
  ExplorerSimParams sim;
  std::vector<std::string> warnings;  ///< what was repaired in the world or left out of it
};

/// Reads the files and the texts. Faults: bad_input with the file and line, or the key.
Outcome<ExploreSetup> load_explore(const ExploreScenario& scenario);

}  // namespace outrider
