// Finds the sides and turns of a mesh that a corner sees in a cone of directions, one polygon at a time.
//
// The functions report them to a viewer. Both ends of the cone belong to it. Directions lead to corners, so
// all decisions are exact in integers. A viewer has three functions:
//
// - `bool opens(const Side&)`: returns true if the search is to look through a side at all.
// - `void see(const Side& turn, Arrow way, uint32_t block)`: a turn is in sight, in the direction `way`, at a
//   side of that block. The side given begins at the turn, and so knows the blocked cell there.
// - `void pass(const Side&, Arrow from, Arrow to, Arrow right, Arrow left)`: a side is in sight. It leads
//   from `from` to `to`; `right` and `left` bound the part of the cone in which it lies.
#pragma once

#include <cstdint>

#include "outrider/path/mesh/mesh.hpp"

namespace outrider::polyanya_search {

/// A position or a direction, relative to a corner.
struct Arrow {
  std::int32_t x = 0, y = 0;
};
/// Returns a value > 0 if b points to the left of a. Exact.
inline std::int64_t turned(Arrow a, Arrow b) { return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x; }
inline Arrow arrow(Cell from, Cell to) { return {to.x - from.x, to.y - from.y}; }

/// The directions from `right` to `left`, both included.
struct Cone {
  Arrow right, left;

  [[nodiscard]] bool holds(Arrow v) const { return turned(right, v) >= 0 && turned(v, left) >= 0; }
};

/// Looks over the sides of a polygon from `first` up to `last`, which follow each other to the left as seen
/// from the corner `at`, as far as they lie in the cone.
template <class Viewer>
void look_over(const NavigationMesh& mesh, Cell at, const Cone& cone, std::uint32_t polygon,
               std::uint32_t first, std::uint32_t last, Viewer& viewer) {
  const auto [right, left] = cone;
  const std::uint32_t begin = mesh.first[polygon], end = mesh.first[polygon + 1];
  Arrow from = arrow(at, mesh.sides[first].at);
  std::int64_t from_right = turned(right, from);
  for (std::uint32_t s = first; s != last;) {
    const NavigationMesh::Side& side = mesh.sides[s];
    s = s + 1 == end ? begin : s + 1;
    const NavigationMesh::Side& next = mesh.sides[s];
    const Arrow to = arrow(at, next.at);
    const std::int64_t to_right = turned(right, to);
    if (to_right >= 0) {
      const std::int64_t from_left = turned(from, left);
      if (from_left < 0) return;
      if (viewer.opens(side)) {
        const std::int64_t to_left = turned(to, left);
        if (side.turn != NavigationMesh::no_turn && from_right >= 0) viewer.see(side, from, side.block);
        if (next.turn != NavigationMesh::no_turn && to_left >= 0) viewer.see(next, to, side.block);
        // An end may lie opposite to the far edge of the cone; then the other edge decides.
        if ((from_left > 0 || from_right < 0) && (to_right > 0 || to_left < 0))
          viewer.pass(side, from, to, from_right >= 0 ? from : right, to_left >= 0 ? to : left);
      }
    }
    from = to;
    from_right = to_right;
  }
}

/// Looks through a side into the polygon behind it; `side` is the index of the side in that polygon.
template <class Viewer>
void look_through(const NavigationMesh& mesh, Cell at, const Cone& cone, std::uint32_t polygon,
                  std::uint32_t side, Viewer& viewer) {
  const std::uint32_t next = side + 1 == mesh.first[polygon + 1] ? mesh.first[polygon] : side + 1;
  look_over(mesh, at, cone, polygon, next, side, viewer);
}

/// Looks from a turn into a polygon at it.
template <class Viewer>
void look_into(const NavigationMesh& mesh, Cell at, const Cone& cone, const NavigationMesh::Wedge& wedge,
               Viewer& viewer) {
  const std::uint32_t begin = mesh.first[wedge.polygon], end = mesh.first[wedge.polygon + 1];
  const std::uint32_t next = wedge.side + 1 == end ? begin : wedge.side + 1;
  const std::uint32_t last = wedge.side == begin ? end - 1 : wedge.side - 1;
  const Arrow from = arrow(at, mesh.sides[next].at), to = arrow(at, mesh.sides[last].at);
  const bool from_inside = turned(cone.right, from) >= 0 && turned(from, cone.left) > 0;
  const bool right_inside = turned(from, cone.right) >= 0 && turned(cone.right, to) > 0;
  if (!from_inside && !right_inside) return;
  const bool to_inside = cone.holds(to);
  const auto see = [&](std::uint32_t corner, Arrow way, const NavigationMesh::Side& side) {
    if (mesh.sides[corner].turn != NavigationMesh::no_turn && viewer.opens(side))
      viewer.see(mesh.sides[corner], way, side.block);
  };
  if (from_inside) see(next, from, mesh.sides[wedge.side]);
  if (to_inside) see(last, to, mesh.sides[last]);
  look_over(mesh, at, {from_inside ? from : cone.right, to_inside ? to : cone.left}, wedge.polygon, next,
            last, viewer);
}

/// Looks from a corner of a polygon, or from a point in it, over all of its sides.
template <class Viewer>
void look_everywhere(const NavigationMesh& mesh, Cell at, std::uint32_t polygon, Viewer& viewer) {
  const std::uint32_t begin = mesh.first[polygon], end = mesh.first[polygon + 1];
  for (std::uint32_t s = begin; s < end; ++s) {
    const NavigationMesh::Side& side = mesh.sides[s];
    if (!viewer.opens(side)) continue;
    const NavigationMesh::Side& next = mesh.sides[s + 1 == end ? begin : s + 1];
    const Arrow from = arrow(at, side.at), to = arrow(at, next.at);
    if (side.turn != NavigationMesh::no_turn) viewer.see(side, from, side.block);
    if (next.turn != NavigationMesh::no_turn) viewer.see(next, to, side.block);
    if (turned(from, to) > 0) viewer.pass(side, from, to, from, to);  // else the corner lies on it
  }
}

}  // namespace outrider::polyanya_search
