// Tangents: the straight legs of shortest paths among polygons.
//
// A shortest path of a disk's centre is made of arcs about grown corners and of legs tangent to the
// arcs at both ends. A place is what such a leg may touch: a free arc, gone round counter-clockwise
// (node 2 i) or clockwise (node 2 i + 1), or a point. Two places have one tangent in each direction:
// supporting when both arcs turn alike, separating when they do not.
#pragma once

#include <optional>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

using Node = std::uint32_t;

struct Place {
  Vec2 centre;
  double radius_m = 0.0;
  double side = 1.0;             ///< 1 when the centre lies to the left of the way, -1 to the right
  const FreeArc* arc = nullptr;  ///< none for a point
};

Place place_of(const PolygonGround& ground, Node node);
inline Place point_place(Vec2 p) { return {p, 0.0, 1.0, nullptr}; }
/// The same arc in the other direction.
constexpr Node turned_round(Node node) { return node ^ 1U; }

struct Tangent {
  Vec2 along;  ///< unit vector
  double length = 0.0;
  Vec2 from;
  Vec2 to;
};
/// Nothing when one circle holds the other, or the places are one.
std::optional<Tangent> tangent(const Place& a, const Place& b);

/// Returns true if a leg in that direction touches the arc of the place where it is free.
bool touches_arc(const Place& place, Vec2 along);

/// How far round its arc a way has come when it is headed along, rad from the beginning of the place.
double progress(const Place& place, Vec2 along);
/// Where it is then.
Vec2 point_at(const Place& place, double progress_rad);

/// A leg to an arc, or to a point.
struct Departure {
  Node to = 0;
  double leaves = 0.0;   ///< progress on the place left, rad
  double arrives = 0.0;  ///< progress on the place reached, rad
  double length = 0.0;
  Vec2 at;  ///< its end
};

/// The leg from a place to an arc, when there is one and it is free; a look for edges counts as a test.
std::optional<Departure> departure(const PolygonGround& ground, const Place& place, Node to,
                                   std::uint64_t& tests);

/// All free legs from a place to the arcs of nodes not below `least`, an even one, by node. Both ways find
/// the same legs.
/// - pairwise: one test against the edges near the leg for each pair that supports or separates.
/// - swept: by a ray that turns round the place over the pieces of the bounds of free space, which it
///   keeps in the order in which it meets them; what the nearest piece hides costs O(log n), and each
///   leg that is left the same test as above.
void departures_pairwise(const PolygonGround& ground, const Place& place, Node least,
                         std::vector<Departure>& found, std::uint64_t& tests);
void departures_swept(const PolygonGround& ground, const Place& place, Node least,
                      std::vector<Departure>& found, std::uint64_t& tests);

}  // namespace outrider
