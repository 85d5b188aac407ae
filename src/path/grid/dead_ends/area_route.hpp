// The areas through which the shortest paths of one query lead, and lower bounds of the length that remains.
//
// The gates on the way are crossed in their order, so the length from a cell to its next gate, the lengths
// between neighbouring gates and that from the last gate to the goal add up to a lower bound; the larger of
// it and the octile distance to the goal is used. It is consistent along the shortest paths between start and
// goal: a step shortens it by no more than its own length. (Back through a gate it may do so by more, but no
// shortest path goes there.) So A* knows the shortest length to each cell of such a path when it expands it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "dead_ends.hpp"
#include "grid/octile.hpp"

namespace outrider {

class AreaRoute {
 public:
  /// Finds the areas from start to goal, which are given by their index in the map, the goal also as a cell
  /// counted from the border. Returns false if nothing joins the two. O(areas on the way).
  bool begin(const DeadEnds& ends, std::uint32_t start, std::uint32_t goal, Cell goal_cell);

  /// Returns false if a free cell with that label lies in a dead end, otherwise sets the lower bound. O(1).
  bool bound(const DeadEnds& ends, std::uint32_t label, Cell c, Octile& remaining) const {
    std::uint32_t place = place_of(label >> 1U);
    if ((label & 1U) != 0) place = std::min(place, place_of(ends.areas[label >> 1U].parent()));
    if (place == DeadEnds::none) return false;
    const Exit& exit = exits_[place];
    const Octile by_gate = octile_distance(c, nearest(exit, c)) + exit.remaining;
    const Octile straight = octile_distance(c, goal_);
    remaining = straight < by_gate ? by_gate : straight;
    return true;
  }

 private:
  /// The gate by which an area is left, or the goal.
  struct Exit {
    std::uint32_t area = DeadEnds::none;
    Cell low, high;
    Octile remaining;  ///< lower bound of the length from there
  };

  struct Place {
    std::uint32_t area = DeadEnds::none;
    std::uint32_t place = DeadEnds::none;  ///< of the area on the way
  };

  /// Returns the slot of an area, or the free one in which it would be.
  [[nodiscard]] std::size_t slot_of(std::uint32_t area) const {
    std::size_t slot = area & (places_.size() - 1);
    while (places_[slot].area != area && places_[slot].area != DeadEnds::none)
      slot = (slot + 1) & (places_.size() - 1);
    return slot;
  }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t area) const { return places_[slot_of(area)].place; }
  static Cell nearest(const Exit& exit, Cell c) {
    return {std::clamp(c.x, exit.low.x, exit.high.x), std::clamp(c.y, exit.low.y, exit.high.y)};
  }
  void add_up();

  Cell goal_;
  std::vector<Place> places_;  // of the areas on the way, open addressing; a power of two
  std::vector<Exit> exits_;    // of the areas from start to goal
  std::vector<Exit> back_;     // from the goal, while they are found
};

}  // namespace outrider
