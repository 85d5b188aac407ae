// Maps of the ROS map_server: a YAML file that names an image.
//
// Reads keys image, resolution, origin [x, y, yaw], negate, occupied_thresh, free_thresh and mode
// (trinary, scale, raw). The image is PGM (P2 or P5, 8 or 16 bits, comments) or PNG, beside the YAML
// file unless its name is absolute; both may be gzip-compressed. Each pixel becomes free, occupied or
// unknown: with p = (255 - v) / 255 (v / 255 when negate), occupied above occupied_thresh, free below
// free_thresh, unknown between. The gradation of mode scale is not kept; in mode raw the pixel is the
// occupancy in percent and more than 100 is unknown. A transparent pixel is unknown. The mean of the
// colours counts.
//
// The Grid stands in the map's own frame turned by yaw_rad about its origin: world = origin +
// R(yaw) (p - origin). Row 0 is the lowest row of the image.
// Errors: bad_input with file, key or line. Bounds: 100 million cells, sides up to 100,000,
// coordinates within 1e6 m, cells from 1e-4 to 1e3 m. Source: ROS map_server 1.16.
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
  double yaw_rad = 0.0;  ///< of the Grid about its origin
};

/// Where the cell's centre lies in the world.
inline Vec2 world_centre(const MapServerMap& map, Cell cell) {
  const GridFrame& frame = map.occupancy.frame;
  const Vec2 d = frame.centre(cell) - frame.origin;
  const Vec2 along = direction(map.yaw_rad);
  return frame.origin + d.x * along + d.y * perpendicular(along);
}

Outcome<MapServerMap> load_map_server(const std::string& path);

/// From the text of the YAML file `name`, beside which the image is looked up.
Outcome<MapServerMap> map_server_from_text(std::string_view text, const std::string& name);

/// An image without a YAML file: its lowest corner at the origin, the thresholds those that are usual.
Outcome<MapServerMap> load_map_image(const std::string& path, double resolution_m);
Outcome<MapServerMap> map_image_from_bytes(std::string_view bytes, const std::string& name,
                                           double resolution_m);

/// Writes `path` (.yaml) and, beside it, the image with the same stem and .pgm: free 254, occupied 0,
/// unknown 205. The image comes first, so a YAML file never names an image that is not there.
Status save_map_server(const std::string& path, const MapServerMap& map);

/// The same files as text, for an image of that name beside the YAML file.
struct MapServerText {
  std::string yaml;
  std::string image;  ///< PGM
};
Outcome<MapServerText> map_server_text(const MapServerMap& map, const std::string& image_name);

}  // namespace outrider
