// Maps for planning on the page. They are uploaded, drawn, or read from the folder, kept under a short name
// for later questions, and shown as JSON.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fields.hpp"
#include "files/folder.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/jobs/plan/ground.hpp"

namespace outrider::server {

inline constexpr std::size_t most_map_cells = 4'000'000;
inline constexpr std::size_t most_map_queries = 1000;

/// Returns the default radius of the job plan.
double usual_radius_m(MapKind kind);

struct KnownMap {
  std::string id;  ///< hash of the map, 16 hexadecimal digits
  std::string name;
  MapShape shape;  ///< cells or polygons, no world
  std::vector<std::string> warnings;
  double radius_m = usual_radius_m(MapKind::map_server);  ///< default radius of the robot
};

/// Returns {"origin", "resolution_m", "width", "height", "runs": [value, count, ...], "yaw_rad"}.
Json grid_json(const Grid<std::uint8_t>& cells, double yaw_rad);
/// Returns [[x, y], ...].
Json points_json(const std::vector<Vec2>& points);
/// Returns {"id", "name", "radius_m", "warnings", "grid" or "polygons"}.
Json map_json(const KnownMap& map);

/// Reads a map from these JSON forms; faults name the member `where`.
Outcome<KnownMap> grid_map_from_json(const Json& grid, const std::string& where);
Outcome<KnownMap> polygon_map_from_json(const Json& polygons, const std::string& where);

/// Packs a map for the transfer from the reader process to the server, with cells as base64, and unpacks it.
Json packed(const KnownMap& map);
Outcome<KnownMap> unpacked(const Json& packed);

/// Reads a map with load_map(). For a world, returns the polygons that block the robot. `path` is as in
/// requests. Call it in the reader process (reading.hpp).
struct ReadMap {
  KnownMap map;
  MapKind kind;
};
Outcome<ReadMap> read_map(const std::string& path, double robot_height_m = PlanGroundOptions{}.height_m);

/// Keeps the most recently used maps: at most 32, and at most 64 MiB of cells in all. Thread rule: any thread
/// may call.
class MapStore {
 public:
  std::shared_ptr<const KnownMap> keep(KnownMap map);
  /// Returns the map; null if it is unknown or forgotten.
  std::shared_ptr<const KnownMap> find(const std::string& id);

 private:
  std::mutex mutex_;
  std::list<std::shared_ptr<const KnownMap>> maps_;  // most recently used first
};

}  // namespace outrider::server
