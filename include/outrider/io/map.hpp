// Maps of every kind from files, told by what is in them, and by the name where that tells nothing:
//
//   map_server YAML   keys such as image and resolution; .yaml, .yml   (io/map_server.hpp)
//   an image alone    PGM or PNG; .pgm, .png                           (io/map_server.hpp)
//   MovingAI          "type octile"; .map                              (io/movingai.hpp)
//   polygons          corners (x,y); .txt                              (io/polygons.hpp)
//   SDF world         <sdf ...>, <?xml ...?>; .sdf, .world             (io/sdf.hpp)
//
// .gz may follow any name, and any file may be gzip-compressed. The file is read once; a map_server YAML file
// and an SDF world lead to others.
//
// Errors: bad_input with file, and with line or key where there is one; those of the readers; a file of which
// neither content nor name tells the kind; more cells than `most_cells`. Bounds: those of the readers, and
// 256 MiB a file. Thread rule: that of load_sdf().
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/polygons.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

enum class MapKind { map_server, image, movingai, polygons, world };
std::string_view to_string(MapKind kind);

/// Cells that may hold something: 0 is free; map_server maps know Occupancy, MovingAI maps 1.
struct MapCells {
  Grid<std::uint8_t> occupancy;
  double yaw_rad = 0.0;  ///< of the grid about its origin, in the world
};

/// Cells of map_server, image and movingai; polygons with their queries; the solids of a world.
using MapShape = std::variant<MapCells, PolygonMap, World>;

struct LoadedMap {
  MapKind kind = MapKind::map_server;
  MapShape shape;
  std::vector<std::string> warnings = {};  ///< what was repaired, left out or assumed, a sentence each
};

struct LoadMapOptions {
  double image_resolution_m = 0.05;      ///< side of a pixel, of an image alone
  std::size_t most_cells = 100'000'000;  ///< a map of more cells is refused
};

Outcome<LoadedMap> load_map(const std::string& path, const LoadMapOptions& options = {});

/// What stands in the way of a robot of that height in a world, as polygons. Faults: those of
/// polygons_from_world().
Outcome<PolygonMap> polygons_of(const World& world, double height_m);

/// The kind of map that the content of a file tells, decompressed; else the one that its name tells.
Outcome<MapKind> map_kind(std::string_view content, const std::string& path);

}  // namespace outrider
