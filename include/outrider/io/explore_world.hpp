// Worlds to explore, from files of several kinds told by the end of the name, .gz after any:
//
//   .sdf .world   SDF (io/sdf.hpp); what its warnings say was left out, slices can put in
//   .yaml .yml    a map of the ROS map_server (io/map_server.hpp)
//   .pgm .png     an image alone: like such a map, its lowest corner at the origin
//   .csv          slices (io/slices.hpp)
//
// On a map every cell that is not free stands as a square block: occupied, unknown, and whatever lies beyond
// the edge of the image, which is unknown as well. Blocks of a rectangle are one solid. Slices and walls
// stand on the floor, `wall_height_m` high. A world without a floor of its own has it at height 0; one that
// is named "default", or not at all, gets the name of its file. The bounds of the world are the box of all
// that stands.
//
// Errors: bad_input with file and line, or the key; a map without a free cell; terrain; more than
// 200,000 solids.
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
