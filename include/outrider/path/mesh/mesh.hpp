// Navigation mesh of a grid: its free space divided into convex polygons, with the sides that join them.
//
// The polygons cover the free cells without overlap. All their corners are corners of the obstacles. Two
// polygons are joined by a side that they share. Polygons that meet only in a point are not joined, so no
// path passes a pinch. A polygon may have corners in the middle of a straight border.
//
// The shared sides are divided into blocks, the biconnected components of the graph of polygons: within a
// block there is more than one way around. A shortest path crosses only the blocks between those of its start
// and its goal, so a search ignores everything behind other blocks, such as dead ends and side rooms.
//
// Construction takes O(cells + n log n) for n corners of obstacles. Memory: 4 bytes per cell, and 110 to 150
// per turn. A mesh can be updated after a change of its ground (src/path/mesh/mesh_change.hpp); removed
// polygons and turns then leave gaps. Thread rule: read-only after construction.
// Sources: Delaunay triangles merged into convex polygons as a search mesh, Cui, Harabor and Grastien (2017);
// blocks, Hopcroft and Tarjan, Algorithm 447 (1973).
#pragma once

#include <cstdint>
#include <limits>
#include <stop_token>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// A navigation mesh as described above.
struct NavigationMesh {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t no_turn = (1U << 30U) - 1;

  /// A side of a polygon, from its corner `at` to the corner of the next side. The inside is on the left.
  struct Side {
    Cell at;
    std::uint32_t polygon = none;       ///< polygon behind the side; none if it is blocked there
    std::uint32_t behind = none;        ///< index of the same side in that polygon
    std::uint32_t block = none;         ///< block of the side; equal for both directions
    std::uint32_t turn : 30 = no_turn;  ///< index in turns[] if a path may turn at `at`
    std::uint32_t blocked : 2 =
        0;  ///< quadrant of the blocked cell at that turn: 1 for the higher x, plus 2 for the higher y
  };

  /// A lattice corner with exactly one blocked cell around it. Shortest paths turn only at these corners.
  struct Turn {
    Cell at;
    std::uint32_t around = 0;    ///< index of its first polygon in around[]
    std::uint32_t polygons = 0;  ///< number of its polygons; 0 if the turn was removed
  };

  /// A polygon at a turn, and the side of the polygon that begins there.
  struct Wedge {
    std::uint32_t polygon = none;
    std::uint32_t side = none;
  };

  std::vector<Side> sides;               ///< by polygon, counter-clockwise
  std::vector<std::uint32_t> first{0U};  ///< index of the first side of each polygon; one more at the end
  std::vector<Turn> turns;
  std::vector<Wedge> around;  ///< the polygons around each turn, turn after turn
  std::vector<std::uint32_t>
      polygon_of;  ///< by frame.index(cell): a polygon that contains its centre; none if blocked

  // The blocks form trees, one for each connected component. After a change of the mesh these are the trees
  // of the old mesh, except that all blocks from the place of the change to the root are merged into one, the
  // core. The core may contain several components.
  static constexpr std::uint32_t gone = none - 1;
  std::vector<std::uint32_t> up;     ///< by polygon: block towards the root; none at the root; or `gone`
  std::vector<std::uint32_t> order;  ///< by polygon: its place in depth-first order; undefined in the core
  std::vector<std::uint32_t> top;    ///< by block: its polygon nearest to the root; none in the core
  std::vector<std::uint32_t> core;   ///< blocks of the core; empty if the blocks of all sides are known

  /// Returns the number of polygons, including removed ones.
  [[nodiscard]] std::size_t polygons() const { return first.size() - 1; }
  [[nodiscard]] bool is_gone(std::uint32_t polygon) const { return up[polygon] == gone; }
  /// Finds all polygons at a corner of a free cell that are connected to that cell around the corner.
  void polygons_at(Cell corner, Cell free_cell, const GridFrame& frame,
                   std::vector<std::uint32_t>& found) const;
  /// Returns the memory used, bytes.
  [[nodiscard]] std::size_t memory() const;
};

/// Builds the mesh of a ground in the model `corners`; after a stop it is empty.
NavigationMesh navigation_mesh(const GridMap& ground, const std::stop_token& stop = {});

}  // namespace outrider
