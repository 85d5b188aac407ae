// Loads maps of all kinds. The kind is detected by the content of the file, or else by its name:
//
//   map_server YAML   keys such as image and resolution; .yaml, .yml   (io/map/map_server.hpp)
//   image             PGM or PNG without YAML; .pgm, .png              (io/map/map_server.hpp)
//   MovingAI          "type octile"; .map                              (io/map/movingai.hpp)
//   polygons          corners (x,y); .txt                              (io/map/polygons.hpp)
//   SDF world         <sdf ...>, <?xml ...?>; .sdf, .world             (io/sdf/sdf.hpp)
//
// Any name may end in .gz, and any file may be gzip-compressed. The file is read once; a map_server YAML file
// and an SDF world refer to other files.
//
// Faults: bad_input with the file, and the line or key if there is one; those of the readers; a file whose
// kind cannot be detected; more cells than `most_cells`. Bounds: those of the readers, and 256 MiB per file.
// Thread rule: that of load_sdf().
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/io/map/polygons.hpp"
#include "outrider/io/sdf/sdf.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

enum class MapKind { map_server, image, movingai, polygons, world };
std::string_view to_string(MapKind kind);

/// The cells of a map; 0 is free. Cells of map_server maps have values of Occupancy; blocked cells of
/// MovingAI maps are 1.
using MapCells = MapServerMap;

/// The content of a map: cells (map_server, image, movingai), polygons with their queries, or a world.
using MapShape = std::variant<MapCells, PolygonMap, World>;

struct LoadedMap {
  MapKind kind = MapKind::map_server;
  MapShape shape;
  std::vector<std::string> warnings = {};  ///< repairs, omissions and assumptions, one sentence each
};

struct LoadMapOptions {
  double image_resolution_m = 0.05;      ///< side of a pixel, for an image without a YAML file
  std::size_t most_cells = 100'000'000;  ///< a map of more cells is refused
  SdfOptions sdf = {};                   ///< where an SDF world finds its models
};

Outcome<LoadedMap> load_map(const std::string& path, const LoadMapOptions& options = {});

/// Returns the obstacles of a world for a robot of that height as polygons. Faults: those of
/// polygons_from_world().
Outcome<PolygonMap> polygons_of(const World& world, double height_m);

/// Detects the kind of a map by the decompressed content of the file, or else by its name.
Outcome<MapKind> map_kind(std::string_view content, const std::string& path);

}  // namespace outrider
