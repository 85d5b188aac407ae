// Tangents: the straight legs of shortest paths among polygons.
//
// A shortest path of the disk's centre consists of arcs around corners, with the radius of the disk, and of
// legs tangent to the arcs at both ends. A place is something that a leg can touch: a free arc that is
// traversed counter-clockwise (node 2 i) or clockwise (node 2 i + 1), or a point. Two places have one tangent
// in each direction: a supporting one if both arcs turn the same way, otherwise a separating one.
#pragma once

#include <optional>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

using Node = std::uint32_t;

/// Legs that touch an arc may miss it, or turn back on it, by so much.
inline constexpr double tangent_slack_rad = 1e-9;

struct Place {
  Vec2 centre;
  double radius_m = 0.0;
  double side = 1.0;             ///< 1 if the centre lies to the left of the path, -1 to the right
  const FreeArc* arc = nullptr;  ///< none for a point
};

Place place_of(const PolygonGround& ground, Node node);
inline Place point_place(Vec2 p) { return {p, 0.0, 1.0, nullptr}; }
/// Returns the same arc in the opposite direction.
constexpr Node turned_round(Node node) { return node ^ 1U; }

struct Tangent {
  Vec2 along;  ///< unit vector
  double length = 0.0;
  Vec2 from;
  Vec2 to;
};
/// Returns the tangent from a to b; nothing if one circle contains the other or the places are the same.
std::optional<Tangent> tangent(const Place& a, const Place& b);

/// Returns true if a leg in that direction touches the arc of the place where it is free.
bool touches_arc(const Place& place, Vec2 along);

/// Returns the angle from the beginning of the place to the point at which a path on its arc has the heading
/// `along`, rad.
double progress(const Place& place, Vec2 along);
/// Returns the point at that angle.
Vec2 point_at(const Place& place, double progress_rad);

/// A leg to an arc, or to a point.
struct Departure {
  Node to = 0;
  double leaves = 0.0;   ///< progress on the place left, rad
  double arrives = 0.0;  ///< progress on the place reached, rad
  double length = 0.0;
  Vec2 at;  ///< end of the leg
};

/// Returns the leg from a place to an arc, if it exists and is free; each query of edges counts as a test.
std::optional<Departure> departure(const PolygonGround& ground, const Place& place, Node to,
                                   std::uint64_t& tests);

/// Return all free legs from a place to the arcs of nodes not below `least` (an even number), ordered by
/// node. Both functions find the same legs.
///  - pairwise: one test against the edges near the leg for each supporting or separating pair.
///  - swept: a ray rotates around the place over the pieces of the border of free space, kept in the order in
///    which it meets them. A leg hidden by the nearest piece costs O(log n); each other leg needs the same
///    test as above.
void departures_pairwise(const PolygonGround& ground, const Place& place, Node least,
                         std::vector<Departure>& found, std::uint64_t& tests);
void departures_swept(const PolygonGround& ground, const Place& place, Node least,
                      std::vector<Departure>& found, std::uint64_t& tests);

}  // namespace outrider
