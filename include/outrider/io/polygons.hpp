// Polygon environments: text with blocks separated by lines of `---`.
//
// First the corners of the boundary, then one obstacle a line, then (if the block is there) one query a
// line, its start and its goal. A corner is (x,y) in metres; white space is free around and within, and
// empty lines are skipped; # begins a comment. The boundary may go over several lines. Polygons are
// simple, of either orientation; those that cross or touch themselves are refused, not repaired.
//
// Errors: bad_input with file:line. Bounds: those of path/polygon_ground.hpp, and 100,000 queries. Files
// may be gzip-compressed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct PointQuery {
  Vec2 start;
  Vec2 goal;
};

struct PolygonMap {
  std::vector<Vec2> boundary;
  std::vector<std::vector<Vec2>> obstacles;
  std::vector<PointQuery> queries;
};

Outcome<PolygonMap> load_polygon_map(const std::string& path);
Outcome<PolygonMap> polygon_map_from_text(std::string_view text, const std::string& name);

/// The text that reads as exactly this map.
std::string polygon_map_text(const PolygonMap& map);

}  // namespace outrider
