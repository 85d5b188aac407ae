// Zone: an area of the ground with a rule for robots: they keep out of it, or are slow in it.
//
// The area is all that lies inside an odd number of the rings of a zone, so a ring inside another is a hole.
// Frame: the world, m.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Zone {
  enum class Kind { keep_out, slow };
  Kind kind = Kind::keep_out;
  double speed_mps = 0.0;                     ///< largest speed in a slow zone
  std::vector<std::vector<Vec2>> rings = {};  ///< corners of simple polygons, of any orientation
  std::string where = {};                     ///< the key, or the file and the place in it

  /// Returns true if a place lies in the area. O(corners).
  [[nodiscard]] bool contains(Vec2 place) const;
  /// Returns the distance from a place to the area, m; 0 inside. O(corners).
  [[nodiscard]] double distance_to(Vec2 place) const;
};

/// Calls `visit` with each edge of a zone.
template <class Visit>
void each_edge(const Zone& zone, Visit visit) {
  for (const std::vector<Vec2>& ring : zone.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) visit(Segment{ring[i], ring[(i + 1) % ring.size()]});
  }
}

inline bool Zone::contains(Vec2 place) const {
  bool inside = false;
  each_edge(*this, [&](Segment edge) {
    if ((edge.a.y > place.y) == (edge.b.y > place.y)) return;
    const double at = edge.a.x + (place.y - edge.a.y) / (edge.b.y - edge.a.y) * (edge.b.x - edge.a.x);
    inside ^= place.x < at;
  });
  return inside;
}

inline double Zone::distance_to(Vec2 place) const {
  if (contains(place)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  each_edge(*this, [&](Segment edge) { least = std::min(least, distance(place, edge)); });
  return least;
}

}  // namespace outrider
