// Loads worlds of several kinds. The kind is detected by the content of the file, or else by its name:
//
//   SDF          <sdf ...>, <?xml ...?>; .sdf, .world   io/sdf/sdf.hpp
//   map_server   its YAML keys; .yaml, .yml             io/map/map_server.hpp
//   image        PGM or PNG without YAML; .pgm, .png    like such a map, with its lowest corner at the origin
//   slices       numbers separated by commas; .csv      io/map/slices.hpp
//
// Any name may end in .gz. In a map, every cell that is not free becomes a square block: occupied and unknown
// cells, and a ring of cells around the image, which are unknown too. Blocks that form a rectangle become one
// solid. Blocks and slices stand on a floor at height 0 and are `wall_height_m` high. A world without a name,
// or with the name "default", gets the name of its file.
//
// Faults: bad_input with file and line, or the key; a map without a free cell; more than 200,000 solids; a
// file whose kind cannot be detected. Thread rule: that of load_sdf().
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/io/sdf/sdf.hpp"

namespace outrider {

struct WorldFileOptions {
  double resolution_m = 0.05;  ///< side of a pixel, for an image without a YAML file
  double wall_height_m = 0.5;  ///< height of slices, walls and the blocks of a map
  SdfOptions sdf = {};         ///< where an SDF world finds its models
};

Outcome<LoadedWorld> load_world(const std::string& path, const WorldFileOptions& options = {});

/// A world to explore. The slices can be the parts that an SDF world lacks according to its warnings.
struct ExploreWorldFiles {
  std::string world = {};   ///< path
  std::string slices = {};  ///< path of additional slices; empty: none
  std::string walls = {};   ///< additional walls, "x1,y1,x2,y2 ..." in m
  WorldFileOptions options = {};
};

/// Loads a world with more slices and walls on its floor. The bounds are the box around everything that
/// stands in it; if nothing stands there, they are those of the file. Faults: those of load_world();
/// bad_input with file and line, or the key; terrain; a world without bounds.
Outcome<LoadedWorld> load_explore_world(const ExploreWorldFiles& files);

}  // namespace outrider
