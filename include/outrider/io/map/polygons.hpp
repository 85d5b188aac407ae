// Polygon environments: text in blocks that are separated by lines of `---`.
//
// The first block has the corners of the boundary, on one or several lines. The second has one obstacle per
// line. The third is optional and has one query per line: start and goal. A corner is (x,y) in metres, with
// optional white space around and within. Empty lines are skipped; # starts a comment. Polygons are simple,
// in either orientation; those that cross or touch themselves are refused, not repaired.
//
// Faults: bad_input with file:line. Bounds: those of path/visibility/polygon_ground.hpp, and 100,000 queries.
// Files may be gzip-compressed.
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

/// Returns the map as text, which reads back to exactly the same map.
std::string polygon_map_text(const PolygonMap& map);

}  // namespace outrider
