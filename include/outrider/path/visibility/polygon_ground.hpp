// PolygonGround: the ground as polygons, prepared for a disk robot.
//
// The robot's centre is free where it lies inside the boundary, outside every obstacle, and at least
// the radius away from all their edges; touching is allowed. Polygons are simple, of either orientation;
// they may touch, share edges and overlap, each other and the boundary. Nothing passes between two that
// touch, nor through a gap narrower than the disk. Free space ends at the edges moved outwards by the
// radius and at true arcs about the corners; the parts of both that bound it are kept here.
// Distances are judged within `contact_m`. Making one costs O(n log n + n k) for n edges, k of them
// beside each, plus an O(n^2) exact test that polygons do not cross themselves. Thread rule: read only
// once made. Fault: bad_input on polygons that cross or touch themselves (they are not repaired), that
// have no area, numbers beyond the limits below, or a radius out of range.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider {

inline constexpr double contact_m = 1e-9;  ///< a disk this deep in an obstacle still only touches it
inline constexpr double farthest_corner_m = 1e4;
inline constexpr double least_polygon_radius_m = 1e-3;
inline constexpr double most_polygon_radius_m = 1e3;
inline constexpr std::size_t most_polygon_corners = 4096;

/// Part of the circle of the radius about a corner that bounds free space, counter-clockwise.
struct FreeArc {
  Vec2 centre;
  double from_rad = 0.0;
  double width_rad = 0.0;  ///< below pi
  Vec2 first;              ///< unit vector of from_rad
  Vec2 middle;
  Vec2 last;
};

/// Edges by the cells of a grid: a cell lists all that come within the radius of a point of it, and a
/// row of cells all that reach as high and as low as a point of it.
struct EdgeIndex {
  Vec2 origin;
  double cell_m = 1.0;
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> first;  ///< of each cell in `items`, and one more
  std::vector<std::uint32_t> items;
  std::vector<std::vector<std::uint32_t>> rows;
};

struct PolygonGround {
  double radius_m = 0.18;
  std::vector<Vec2> boundary;                ///< clockwise
  std::vector<std::vector<Vec2>> obstacles;  ///< counter-clockwise
  Box2 bounds;
  std::vector<Segment> edges;  ///< of all polygons, solid on the left
  std::vector<FreeArc> arcs;
  std::vector<Segment> walls;             ///< free parts of the edges moved by the radius, solid on the left
  std::vector<std::uint32_t> first_arc;   ///< by edge: those about its corner `a` begin here; one more
  std::vector<std::uint32_t> first_wall;  ///< by edge: its walls begin here; one more
  EdgeIndex index;

  static Outcome<PolygonGround> of(std::vector<Vec2> boundary, std::vector<std::vector<Vec2>> obstacles,
                                   double radius_m);

  /// This ground with one more obstacle, the last; the same as one made anew. Arcs and walls farther than
  /// two radii from the box of the new obstacle are copied. Faults: those of of().
  [[nodiscard]] Outcome<PolygonGround> with_obstacle(const std::vector<Vec2>& corners) const;
  /// This ground without obstacles[which]; those after it move up. Fault: bad_input when there is none.
  [[nodiscard]] Outcome<PolygonGround> without_obstacle(std::size_t which) const;

  /// Outside the boundary. O(n).
  [[nodiscard]] bool outside(Vec2 p) const;
  /// Outside the boundary or inside an obstacle. O(edges as high as p).
  [[nodiscard]] bool solid(Vec2 p) const;
  /// To the nearest edge. O(n).
  [[nodiscard]] double edge_distance(Vec2 p) const;
  /// Returns true if the disk may stand there.
  [[nodiscard]] bool point_free(Vec2 p) const;
  /// Returns true if the disk may move along the segment. It must be able to stand at one end.
  [[nodiscard]] bool segment_free(Segment s) const;
};

/// Checks that the corners make a simple polygon with an area; `name` begins the message of the fault.
Status check_polygon(const std::vector<Vec2>& corners, std::string_view name);

}  // namespace outrider
