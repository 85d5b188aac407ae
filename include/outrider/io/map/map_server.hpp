// Maps of the ROS map_server: a YAML file that names an image.
//
// Reads the keys image, resolution, origin [x, y, yaw], negate, occupied_thresh, free_thresh and mode
// (trinary, scale, raw). The image is PGM (P2 or P5, 8 or 16 bits, comments) or PNG. It is beside the YAML
// file unless its name is absolute. Both files may be gzip-compressed. Each pixel becomes free, occupied or
// unknown: with p = (255 - v) / 255 (v / 255 if negate), it is occupied above occupied_thresh, free below
// free_thresh and unknown between. The intermediate values of mode scale are not kept. In mode raw, the pixel
// is the occupancy in percent; values above 100 are unknown. Transparent pixels are unknown. Of coloured
// pixels, v is the mean of the channels.
//
// The Grid is in the frame of the map, which is turned by yaw_rad about its origin: world = origin +
// R(yaw) (p - origin). Row 0 is the lowest row of the image.
// Faults: bad_input with file, key or line. Bounds: 100 million cells, sides up to 100,000, coordinates
// within 1e6 m, cells from 1e-4 to 1e3 m. Source: ROS map_server 1.16.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

struct MapServerMap {
  Grid<std::uint8_t> occupancy;
  double yaw_rad = 0.0;  ///< rotation of the Grid about its origin
};

/// Returns the centre of a cell in the world frame, m.
inline Vec2 world_centre(const MapServerMap& map, Cell cell) {
  const GridFrame& frame = map.occupancy.frame;
  return frame.origin + rotated(map.yaw_rad, frame.centre(cell) - frame.origin);
}

Outcome<MapServerMap> load_map_server(const std::string& path);

/// Reads a map from the text of the YAML file `name`. The image is searched beside that file.
Outcome<MapServerMap> map_server_from_text(std::string_view text, const std::string& name);

/// The values of a map in percent; -1: unknown. In mode scale those between the thresholds are kept, rounded.
struct MapServerValues {
  Grid<std::int8_t> percent;
  double yaw_rad = 0.0;  ///< rotation of the Grid about its origin
};
Outcome<MapServerValues> load_map_server_values(const std::string& path);

/// Reads an image without a YAML file. Its lowest corner is at the origin; the thresholds are the usual ones.
Outcome<MapServerMap> map_image_from_bytes(std::string_view bytes, const std::string& name,
                                           double resolution_m);

/// Writes `path` (.yaml) and, beside it, the image with the same stem and .pgm: free 254, occupied 0, unknown
/// 205. The image is written first, so a YAML file never names a missing image.
Status save_map_server(const std::string& path, const MapServerMap& map);

/// The content of the two files.
struct MapServerText {
  std::string yaml;
  std::string image;  ///< PGM
};
/// Returns the content of the two files for an image of that name beside the YAML file.
Outcome<MapServerText> map_server_text(const MapServerMap& map, const std::string& image_name);

}  // namespace outrider
