// Winding: the way in which a taut path bends around the blocked cell at a turn.
//
// The blocked cell fills one quadrant. A taut path arrives in one of the two neighbouring quadrants of
// directions and continues in the same one, between its direction and the border of the cell; straight on is
// allowed. So if the legs that leave a turn on one side are sorted by angle from the border, an arriving path
// may continue along the first few of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "outrider/path/mesh/mesh.hpp"

namespace outrider::hub_labelling {

class Winding {
 public:
  enum class Side : std::uint8_t { level, upright, neither };  ///< the border along which a path goes on

  /// `quadrant` as in NavigationMesh::Side::blocked.
  explicit Winding(std::uint32_t quadrant = 0)
      : x_((quadrant & 1U) != 0 ? 1 : -1), y_((quadrant & 2U) != 0 ? 1 : -1) {}

  /// Returns the side of a leg to or from the turn; `neither` if it enters or leaves the blocked cell.
  [[nodiscard]] Side side(Cell way) const {
    const int x = x_ * way.x, y = y_ * way.y;
    if (x <= 0 && y >= 0) return Side::upright;
    return x >= 0 && y <= 0 ? Side::level : Side::neither;
  }
  /// Returns a value > 0 if b, on the same side, lies farther from the border than a. Exact.
  [[nodiscard]] std::int64_t farther(Side side, Cell a, Cell b) const {
    const std::int64_t left = x_ * y_ * (std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x);
    return side == Side::upright ? left : -left;
  }

 private:
  int x_, y_;
};

/// Returns the windings of all turns.
inline std::vector<Winding> windings_of(const NavigationMesh& mesh) {
  std::vector<Winding> windings(mesh.turns.size());
  for (const NavigationMesh::Side& side : mesh.sides) {
    if (side.turn != NavigationMesh::no_turn) windings[side.turn] = Winding(side.blocked);
  }
  return windings;
}

/// Items that leave a turn, each with its leg `way`: on both sides, in order from the border.
template <class Leaving>
struct Fan {
  std::vector<Leaving> level, upright;

  /// Adds an item to a side.
  void add(Winding::Side side, const Leaving& thing) {
    (side == Winding::Side::level ? level : upright).push_back(thing);
  }
  void sort(const Winding& winding) {
    const auto sort_one = [&](Winding::Side side, std::vector<Leaving>& things) {
      std::stable_sort(things.begin(), things.end(), [&](const Leaving& a, const Leaving& b) {
        return winding.farther(side, a.way, b.way) > 0;
      });
    };
    sort_one(Winding::Side::level, level);
    sort_one(Winding::Side::upright, upright);
  }
  /// Calls visit() for each item to which a taut path that arrives along `came` may continue.
  template <class Visit>
  void onward(const Winding& winding, Cell came, Visit visit) const {
    const Winding::Side side = winding.side(came);
    for (const Leaving& thing : side == Winding::Side::level ? level : upright) {
      if (winding.farther(side, came, thing.way) > 0) return;
      visit(thing);
    }
  }
};

}  // namespace outrider::hub_labelling
