// Discovery records when each cell of a growing map first became known, and makes the map of a report from
// it.
//
// A map may grow between two calls of note(), as long as the lattice of its cells stays the same; then each
// cell keeps its time. note() takes O(cells changed), or O(cells of the map) for a redrawn map. Thread rule:
// one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "outrider/report/page_report.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

class Discovery {
 public:
  /// Records the state of the map at `time_s`. `occupancy` holds values of Occupancy. Only the cells with the
  /// indices `changed` may have changed since the last call, or any cell if `redrawn` is true. Times must not
  /// decrease.
  void note(const Grid<std::uint8_t>& occupancy, bool redrawn, std::span<const std::size_t> changed,
            double time_s);

  /// Returns the known part of the map with at most `most_cells` cells, and never more than most_drawn_cells.
  /// Each drawn cell merges k x k cells of the map, with the smallest k that suffices: it is occupied if any
  /// of them is, else free if any of them is, and it became known with the first of them. Uses at most 500
  /// steps of time. O(cells of the map).
  [[nodiscard]] ReportMap map(const Grid<std::uint8_t>& occupancy, std::size_t most_cells = 150'000) const;

 private:
  static constexpr float never = std::numeric_limits<float>::infinity();

  void follow(const GridFrame& frame);

  Grid<float> known_s_;  ///< by cell: when it first became known
  double end_s_ = 0.0;
};

}  // namespace outrider
