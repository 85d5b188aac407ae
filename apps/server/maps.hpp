// Maps for planning from the page: read from a file that was dropped, drawn, or lying in the folder; kept
// under a short name for the questions that follow; shown as JSON.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fields.hpp"
#include "folder.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/polygons.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/world.hpp"

namespace outrider::server {

inline constexpr std::size_t most_map_cells = 4'000'000;
inline constexpr std::size_t most_map_queries = 1000;

struct CellMap {
  Grid<std::uint8_t> occupancy;  ///< Occupancy of each cell
  double yaw_rad = 0.0;          ///< of the grid about its origin, in the world
};

struct KnownMap {
  std::string id;  ///< a hash of what follows, 16 hexadecimal digits
  std::string name;
  std::variant<CellMap, PolygonMap> shape;
  std::vector<std::string> warnings;
  double radius_m = 0.18;  ///< of the robot where none is asked for; 0 on MovingAI maps
};

/// {"origin", "resolution_m", "width", "height", "runs": [value, count, ...], "yaw_rad"}
Json grid_json(const Grid<std::uint8_t>& cells, double yaw_rad);
/// {"id", "name", "radius_m", "warnings", "grid" or "polygons"}
Json map_json(const KnownMap& map);

/// From those JSON forms; `where` names the member.
Outcome<KnownMap> grid_map_from_json(const Json& grid, const std::string& where);
Outcome<KnownMap> polygon_map_from_json(const Json& polygons, const std::string& where);

/// A map between the process that read it and the server, its cells as base64; and back.
Json packed(const KnownMap& map);
Outcome<KnownMap> unpacked(const Json& packed);

/// By its name: map_server .yaml, .png and .pgm alone (0.05 m a pixel), .map, polygons .txt, .sdf and .world
/// as the polygons that stand in the way of a robot 0.2 m high; .gz after any. `path` is as in requests. For
/// the process that reads (reading.hpp).
Outcome<KnownMap> load_known_map(const std::string& path, const Folder& folder);

/// What stands in the way of a robot of that radius and height in a world, as polygons.
Outcome<PolygonMap> polygons_of(const World& world, double radius_m, double height_m);

/// The newest maps: at most 32, and of those of more than 1 MiB at most 64 MiB in all. Thread rule: any
/// thread may ask.
class MapStore {
 public:
  std::shared_ptr<const KnownMap> keep(KnownMap map);
  /// Null when it was never there or is forgotten.
  std::shared_ptr<const KnownMap> find(const std::string& id);

 private:
  std::mutex mutex_;
  std::list<std::shared_ptr<const KnownMap>> maps_;  // newest use first
};

}  // namespace outrider::server
