// The trace of a search on polygons, whose states are numbers of its own: each gets a place, and a number
// that no other search of the same question has.
#pragma once

#include <vector>

#include "outrider/core/trace.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

class PlacedTrace {
 public:
  /// Before the search begins. Null: nothing is traced, and nothing done.
  explicit PlacedTrace(Trace* trace);

  /// Once it has ended: where the states are that it recorded.
  template <class PlaceOf>
  void report(PlaceOf place_of) const {
    if (trace_ == nullptr) return;
    for (const std::uint32_t state : renumber()) {
      const Vec2 place = place_of(state);
      trace_->places.push_back({place.x, place.y});
    }
  }

 private:
  /// Numbers the states anew, from the count of places on; those they had before, in the new order.
  [[nodiscard]] std::vector<std::uint32_t> renumber() const;

  Trace* trace_;
  std::size_t first_expansion_ = 0;
  std::size_t first_opening_ = 0;
};

}  // namespace outrider
