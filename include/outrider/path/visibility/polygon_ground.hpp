// PolygonGround: the ground as polygons, prepared for a disk robot.
//
// A position of the robot's centre is free if it is inside the boundary, outside every obstacle, and at least
// the radius away from all their edges; touching is allowed. Polygons are simple and have any orientation.
// They may touch, share edges and overlap, each other and the boundary. The robot cannot pass between two
// polygons that touch, nor through a gap narrower than the disk. The free space is bounded by the edges
// offset by the radius and by exact arcs around the corners; the parts that bound it are stored here.
// Distances are compared with a tolerance of `contact_m`.
//
// Construction takes O(n log n + n k) for n edges with k edges near each, plus an O(n^2) exact test that
// polygons do not cross themselves. Thread rule: read-only after construction. Fault: bad_input for polygons
// that cross or touch themselves (they are not repaired) or have no area, for numbers beyond the limits
// below, and for a radius out of range.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider {

inline constexpr double contact_m = 1e-9;  ///< a disk that overlaps an obstacle by this much only touches it
inline constexpr double farthest_corner_m = 1e4;
inline constexpr double least_polygon_radius_m = 1e-3;
inline constexpr double most_polygon_radius_m = 1e3;
inline constexpr std::size_t most_polygon_corners = 4096;

/// A part of the circle of the robot radius around a corner that bounds the free space, counter-clockwise.
struct FreeArc {
  Vec2 centre;
  double from_rad = 0.0;
  double width_rad = 0.0;  ///< less than pi
  Vec2 first;              ///< unit vector in the direction from_rad
  Vec2 middle;             ///< unit vector to the middle of the arc
  Vec2 last;               ///< unit vector to the end of the arc
};

/// A spatial index of the edges on a grid. Each cell lists all edges within the radius of one of its points.
/// Each row of cells lists all edges whose y range overlaps that of the row.
struct EdgeIndex {
  Vec2 origin;
  double cell_m = 1.0;
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> first;              ///< start of each cell in `items`; one more at the end
  std::vector<std::uint32_t> items;              ///< indices of edges
  std::vector<std::vector<std::uint32_t>> rows;  ///< indices of edges, by row
};

/// Polygons as described above.
struct PolygonGround {
  double radius_m = 0.18;
  std::vector<Vec2> boundary;                ///< clockwise
  std::vector<std::vector<Vec2>> obstacles;  ///< counter-clockwise
  Box2 bounds;
  std::vector<Segment> edges;  ///< edges of all polygons, solid on the left
  std::vector<FreeArc> arcs;
  std::vector<Segment> walls;             ///< free parts of the edges offset by the radius, solid on the left
  std::vector<std::uint32_t> first_arc;   ///< by edge: first arc around its corner `a`; one more at the end
  std::vector<std::uint32_t> first_wall;  ///< by edge: its first wall; one more at the end
  EdgeIndex index;

  /// Makes the ground. Faults: see the head of this file.
  static Outcome<PolygonGround> of(std::vector<Vec2> boundary, std::vector<std::vector<Vec2>> obstacles,
                                   double radius_m);

  /// Returns this ground with one more obstacle, appended as the last. The result equals a ground made from
  /// scratch. Arcs and walls farther than two radii from the box of the new obstacle are copied. Faults:
  /// those of of().
  [[nodiscard]] Outcome<PolygonGround> with_obstacle(const std::vector<Vec2>& corners) const;
  /// Returns this ground without obstacles[which]; the indices of later obstacles decrease by one. Fault:
  /// bad_input if there is no such obstacle.
  [[nodiscard]] Outcome<PolygonGround> without_obstacle(std::size_t which) const;

  /// Returns true if p is outside the boundary. O(n).
  [[nodiscard]] bool outside(Vec2 p) const;
  /// Returns true if p is outside the boundary or inside an obstacle. O(edges whose row contains p).
  [[nodiscard]] bool solid(Vec2 p) const;
  /// Returns the distance to the nearest edge, m. O(n).
  [[nodiscard]] double edge_distance(Vec2 p) const;
  /// Returns true if the disk may stand there.
  [[nodiscard]] bool point_free(Vec2 p) const;
  /// Returns true if the disk may move along the segment. It must be able to stand at one end.
  [[nodiscard]] bool segment_free(Segment s) const;
};

/// Checks that the corners make a simple polygon with an area; `name` begins the message of the fault.
Status check_polygon(const std::vector<Vec2>& corners, std::string_view name);

}  // namespace outrider
