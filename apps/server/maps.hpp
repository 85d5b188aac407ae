// Maps for planning from the page: read from a file that was dropped, drawn, or lying in the folder; kept
// under a short name for the questions that follow; shown as JSON.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fields.hpp"
#include "folder.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/map.hpp"
#include "outrider/jobs/plan/ground.hpp"

namespace outrider::server {

inline constexpr std::size_t most_map_cells = 4'000'000;
inline constexpr std::size_t most_map_queries = 1000;

/// That of the job plan where none is given.
double usual_radius_m(MapKind kind);

struct KnownMap {
  std::string id;  ///< a hash of what follows, 16 hexadecimal digits
  std::string name;
  MapShape shape;  ///< cells or polygons, no world
  std::vector<std::string> warnings;
  double radius_m = usual_radius_m(MapKind::map_server);  ///< of the robot where none is asked for
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

/// What load_map() reads; of a world the polygons that stand in the way of a robot. `path` is as in requests.
/// For the process that reads (reading.hpp).
struct ReadMap {
  KnownMap map;
  MapKind kind;
};
Outcome<ReadMap> read_map(const std::string& path, const Folder& folder,
                          double robot_height_m = PlanGroundOptions{}.height_m);

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
