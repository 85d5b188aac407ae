// Worlds to explore: the files of io/world_file.hpp, with additional slices and walls.
//
// Slices can add the parts that an SDF world lacks according to its warnings. Slices and walls stand on the
// floor and are `wall_height_m` high. The bounds of the world are the box around everything that stands in
// it; if nothing stands there, they are those of the file.
//
// Faults: those of load_world(); bad_input with file and line, or the key; terrain; a world without bounds;
// more than 200,000 solids.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/io/sdf.hpp"

namespace outrider {

struct ExploreWorldFiles {
  std::string world = {};      ///< path
  std::string slices = {};     ///< path of additional slices; empty: none
  std::string walls = {};      ///< additional walls, "x1,y1,x2,y2 ..." in m
  double resolution_m = 0.05;  ///< side of a pixel, for an image without a YAML file
  double wall_height_m = 0.5;  ///< height of slices, walls and the blocks of a map
  SdfOptions sdf = {};         ///< where an SDF world finds its models
};

Outcome<LoadedWorld> load_explore_world(const ExploreWorldFiles& files);

}  // namespace outrider
