// Turns that no shortest path can avoid, in the corridors of a mesh.
//
// In a corridor each polygon is joined to the next one, towards the root of its tree, by a single side
// (mesh.hpp). From a corner in it the string is pulled through these sides. At the first one of which the
// corner sees nothing past a turn, that turn is the next one on every shortest path from the corner to
// whatever lies beyond, whichever way the path came and wherever it goes. So the ends of a query move up to
// where their corridors meet, from turn to turn, without a search.
//
// Memory: 12 bytes a turn and 8 a polygon. O(sides of the corridors), about a twentieth of the time for the
// mesh. Source: the funnel of Lee and Preparata, Euclidean shortest paths in the presence of rectilinear
// barriers (1984).
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "mesh/mesh_sight.hpp"

namespace outrider::polyanya_search {

/// The next turn on the shortest paths from a corner to all polygons of its tree, but some.
struct ForcedTurn {
  std::uint32_t turn = NavigationMesh::no_turn;
  std::uint32_t first = 0, last = 0;  ///< order of those polygons, both included

  [[nodiscard]] bool on_way_to(std::uint32_t order) const {
    return turn != NavigationMesh::no_turn && (order < first || order > last);
  }
};

class ForcedTurns {
 public:
  /// Finds those after all turns. The blocks of all sides must be known.
  void find(const NavigationMesh& mesh, const std::stop_token& stop = {});
  void forget() { after_.clear(); }
  [[nodiscard]] bool known() const { return !after_.empty(); }

  [[nodiscard]] const ForcedTurn& after(std::uint32_t turn) const { return after_[turn]; }
  /// Returns the one after a corner, of whose polygons this is the first in order.
  [[nodiscard]] ForcedTurn from(const NavigationMesh& mesh, Cell corner, std::uint32_t polygon) const;

 private:
  std::vector<ForcedTurn> after_;    // by turn
  std::vector<std::uint32_t> up_;    // by polygon: its only side towards the root; none if there is not one
  std::vector<std::uint32_t> last_;  // by polygon: the last in order of those behind it
};

}  // namespace outrider::polyanya_search
