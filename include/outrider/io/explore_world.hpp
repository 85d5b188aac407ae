// Worlds to explore: the files of io/world_file.hpp, with slices and walls that stand in the world too.
//
// What the warnings of an SDF world say was left out, slices can put in. Slices and walls stand on the floor,
// `wall_height_m` high. The bounds of the world are the box of all that stands.
//
// Errors: those of load_world(), bad_input with file and line, or the key; terrain; more than 200,000 solids.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/io/sdf.hpp"

namespace outrider {

struct ExploreWorldFiles {
  std::string world = {};      ///< path
  std::string slices = {};     ///< path of slices that stand in the world too; empty: none
  std::string walls = {};      ///< more walls, "x1,y1,x2,y2 ..." in m
  double resolution_m = 0.05;  ///< of an image that stands alone
  double wall_height_m = 0.5;  ///< of slices, walls and the blocks of a map
};

Outcome<LoadedWorld> load_explore_world(const ExploreWorldFiles& files);

}  // namespace outrider
