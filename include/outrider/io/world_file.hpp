// Worlds from files of several kinds, told by what is in them, and by the name where that tells nothing, .gz
// after any:
//
//   SDF          <sdf ...>, <?xml ...?>; .sdf, .world   io/sdf.hpp
//   map_server   its YAML keys; .yaml, .yml             io/map_server.hpp
//   an image     PGM or PNG, alone; .pgm, .png          like such a map, its lowest corner at the origin
//   slices       numbers between commas; .csv           io/slices.hpp
//
// On a map every cell that is not free stands as a square block: occupied, unknown, and whatever lies beyond
// the edge of the image, which is unknown as well. Blocks of a rectangle are one solid. Blocks and slices
// stand on the floor, `wall_height_m` high. A world without a floor of its own has it at height 0; one that
// is named "default", or not at all, gets the name of its file.
//
// Errors: bad_input with file and line, or the key; a map without a free cell; more than 200,000 solids; a
// file of which neither content nor name tells the kind. Thread rule: that of load_sdf().
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/io/sdf.hpp"

namespace outrider {

struct WorldFileOptions {
  double resolution_m = 0.05;  ///< of an image that stands alone
  double wall_height_m = 0.5;  ///< of slices and the blocks of a map
};

Outcome<LoadedWorld> load_world(const std::string& path, const WorldFileOptions& options = {});

}  // namespace outrider
