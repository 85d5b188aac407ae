#include "area_route.hpp"

#include <bit>

namespace outrider {
namespace {

/// Returns the octile length between two ranges of cells along one axis and two along the other.
int gap(int low, int high, int other_low, int other_high) {
  return std::max({0, other_low - high, low - other_high});
}

}  // namespace

bool AreaRoute::begin(const DeadEnds& ends, std::uint32_t start, std::uint32_t goal, Cell goal_cell) {
  goal_ = goal_cell;
  exits_.clear();
  back_.clear();
  std::uint32_t a = ends.label(start) >> 1U, b = ends.label(goal) >> 1U;
  back_.push_back({b, goal_, goal_, {}});
  while (a != b) {  // climb from the later one, which is not above the other, until both meet
    const DeadEnds::Area& last = ends.areas[std::max(a, b)];
    if (last.parent() == DeadEnds::none) return false;
    const Cell low = last.low(ends.stride), high = last.high(ends.stride);
    if (a > b) {
      exits_.push_back({a, low, high, {}});
      a = last.parent();
    } else {
      b = last.parent();
      back_.push_back({b, low, high, {}});
    }
  }
  exits_.insert(exits_.end(), back_.rbegin(), back_.rend());
  add_up();
  return true;
}

/// Marks the areas on the way, and adds up the lengths between gates from the goal on.
void AreaRoute::add_up() {
  places_.assign(std::bit_ceil(4 * exits_.size()), {});
  for (std::size_t i = exits_.size(); i-- > 0;) {
    Exit& exit = exits_[i];
    places_[slot_of(exit.area)] = {exit.area, static_cast<std::uint32_t>(i)};
    if (i + 1 == exits_.size()) continue;
    const Exit& next = exits_[i + 1];
    const Cell apart{gap(exit.low.x, exit.high.x, next.low.x, next.high.x),
                     gap(exit.low.y, exit.high.y, next.low.y, next.high.y)};
    exit.remaining = next.remaining + octile_distance({0, 0}, apart);
  }
}

}  // namespace outrider
