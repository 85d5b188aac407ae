// The trace of a search on polygons, whose states are numbers of its own. Each state gets a place, and a
// number that no other search of the same query uses.
#pragma once

#include <vector>

#include "outrider/core/trace.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

class PlacedTrace {
 public:
  /// Construct it before the search begins. If `trace` is null, nothing is traced.
  explicit PlacedTrace(Trace* trace);

  /// Call it after the search, with the places of the recorded states.
  template <class PlaceOf>
  void report(PlaceOf place_of) const {
    if (trace_ == nullptr) return;
    for (const std::uint32_t state : renumber()) {
      const Vec2 place = place_of(state);
      trace_->places.push_back({place.x, place.y});
    }
  }

 private:
  /// Renumbers the states, from the number of known places on, and returns their old numbers in the new
  /// order.
  [[nodiscard]] std::vector<std::uint32_t> renumber() const;

  Trace* trace_;
  std::size_t first_expansion_ = 0;
  std::size_t first_opening_ = 0;
};

}  // namespace outrider
