// The free space of a saved map as the area to cover.
//
// A saved map is what `outrider` and ROS's map_saver write and map_server reads: YAML and an image
// (io/map/map_server.hpp). Ground that the map shows as occupied or unknown is not free. One part of the free
// space is covered, that with the start or else the largest, without what the robot cannot reach; it is
// simplified (world/free_parts.hpp), so the area lies inside the free space.
#pragma once

#include <optional>
#include <string>

#include "outrider/io/map/cover_area.hpp"
#include "outrider/io/map/map_server.hpp"

namespace outrider {

/// Options for making an area of a map.
struct SavedMapOptions {
  double radius_m = 0.1;      ///< of the disk that covers
  double tolerance_m = 0.0;   ///< how far inside the free space the area may end; 0: two cells of the map
  std::optional<Vec2> start;  ///< chooses the part, in the frame of the world
};

/// Reads a saved map; nothing if the file is none. Faults: those of the reader, with file, line or key.
Outcome<std::optional<MapServerMap>> saved_map(const std::string& path);

/// Returns the area, whose note says what is left out. Faults: bad_input if no free cell is wide enough for
/// the robot, for more cells than 25 million or more than 32766 on a side, and if the area has more corners
/// than path/visibility/polygon_ground.hpp takes. O(cells).
Outcome<CoverArea> area_of_map(const MapServerMap& map, const std::string& name,
                               const SavedMapOptions& options);

}  // namespace outrider
