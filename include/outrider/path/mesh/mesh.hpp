// Navigation mesh of a grid: its free space cut into convex polygons, with the sides between them.
//
// The polygons cover the free cells without overlap; their corners are those of the obstacles, and no
// others. Two polygons are joined by a side that they share; polygons that meet in a point alone are not
// joined, so no pinch is passed. A polygon may have corners on a straight border.
//
// The shared sides fall into blocks: those among which there is more than one way around (the
// biconnected components of the polygons as a graph). A shortest path crosses the blocks between those
// of its start and its goal and no others, whatever lies behind them: dead ends, side rooms, other trees.
//
// O(cells + n log n) to make, for n corners of obstacles; 4 bytes a cell, and 110 to 150 a turn. A mesh may
// follow a change of its ground (src/path/mesh_change.hpp); polygons and turns that are gone then leave gaps.
// Thread rule: read only once made.
// Sources: Delaunay triangles joined to convex polygons as a mesh for searching, Cui, Harabor and Grastien
// (2017); blocks, Hopcroft and Tarjan, Algorithm 447 (1973).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

struct NavigationMesh {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t no_turn = (1U << 30U) - 1;

  /// A side of a polygon, from this corner to that of the next side, the inside on the left.
  struct Side {
    Cell at;
    std::uint32_t polygon = none;       ///< behind the side; none when it is blocked there
    std::uint32_t behind = none;        ///< the same side, as that polygon has it
    std::uint32_t block = none;         ///< the same as seen from both sides
    std::uint32_t turn : 30 = no_turn;  ///< turns[] when a path may turn at `at`
    std::uint32_t blocked : 2 =
        0;  ///< there: quadrant of the blocked cell, 1 for the higher x, plus 2 for the higher y
  };

  /// A corner of the lattice with just one blocked cell around it: where shortest paths turn.
  struct Turn {
    Cell at;
    std::uint32_t around = 0;    ///< first of its polygons in around[]
    std::uint32_t polygons = 0;  ///< how many; none when it is gone
  };

  /// A polygon at a turn, and its side that begins there.
  struct Wedge {
    std::uint32_t polygon = none;
    std::uint32_t side = none;
  };

  std::vector<Side> sides;               ///< polygon after polygon, counter-clockwise
  std::vector<std::uint32_t> first{0U};  ///< side of each polygon; one more at the end
  std::vector<Turn> turns;
  std::vector<Wedge> around;  ///< by turn
  std::vector<std::uint32_t>
      polygon_of;  ///< by frame.index(cell): one that holds its centre; none where blocked

  // The blocks hang together as trees, one for each connected part. Where the mesh has changed, they are
  // those of before, and all from there to the root are one, the core, which may hold several parts.
  static constexpr std::uint32_t gone = none - 1;
  std::vector<std::uint32_t> up;     ///< by polygon: the block towards the root; none at the root; or gone
  std::vector<std::uint32_t> depth;  ///< by polygon: blocks between it and the root; any in the core
  std::vector<std::uint32_t> top;    ///< by block: its polygon nearest to the root; none in the core
  std::vector<std::uint32_t> core;   ///< blocks; none when all are known

  /// Those that are gone are counted.
  [[nodiscard]] std::size_t polygons() const { return first.size() - 1; }
  [[nodiscard]] bool is_gone(std::uint32_t polygon) const { return up[polygon] == gone; }
  /// All polygons that a corner of a free cell belongs to and that hang together around it.
  void polygons_at(Cell corner, Cell free_cell, const GridFrame& frame,
                   std::vector<std::uint32_t>& found) const;
  /// Bytes of memory.
  [[nodiscard]] std::size_t memory() const;
};

/// The mesh of a ground in the model `corners`.
NavigationMesh navigation_mesh(const GridMap& ground);

}  // namespace outrider
