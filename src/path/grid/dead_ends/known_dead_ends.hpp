// The dead ends of the ground of a planner, kept while the ground stays the same.
#pragma once

#include <cstdint>

#include "dead_ends.hpp"

namespace outrider {

/// Finds dead ends at once for a new ground. A change of the ground makes them unknown; they are found again
/// when the searches since then have come to an eighth as many expansions as there are cells, which costs
/// about as much. Not for more than 4 million cells, to keep a single query on a large map cheap.
class KnownDeadEnds {
 public:
  static constexpr std::size_t most_cells = std::size_t{1} << 22U;

  /// `spread`: keeps the labels cell by cell.
  explicit KnownDeadEnds(bool spread = false) : spread_(spread) {}

  void make(const GridMap& ground) {
    known_ = ground.frame.size() <= most_cells;
    ends_ = known_ ? dead_ends_of(ground) : DeadEnds{};
    if (known_ && spread_) ends_.spread(ground.marks.size());
  }
  void change() {
    known_ = false;
    spent_ = 0;
  }
  /// Returns the dead ends of the ground; null if they are not known.
  const DeadEnds* of(const GridMap& ground) {
    if (!known_ && 8 * spent_ >= ground.frame.size()) make(ground);
    return known_ ? &ends_ : nullptr;
  }
  /// Counts the expansions of a search.
  void spend(std::uint64_t expansions) { spent_ += known_ ? 0 : expansions; }

 private:
  bool spread_;
  DeadEnds ends_;
  bool known_ = false;
  std::uint64_t spent_ = 0;
};

}  // namespace outrider
