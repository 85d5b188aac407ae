// Discovery: when each cell of a map that grows was first known, and the map of a report made from that.
//
// Maps may grow between two notes, as long as the lattice of their cells stays: then a cell keeps its time.
// note(): O(cells changed); O(cells of the map) where it was redrawn. Thread rule: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "outrider/report/report.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

class Discovery {
 public:
  /// `occupancy` holds values of Occupancy. Since the note before, the cells with these numbers may have
  /// changed, or with `redrawn` any of them. Times do not decrease.
  void note(const Grid<std::uint8_t>& occupancy, bool redrawn, std::span<const std::size_t> changed,
            double time_s);

  /// The part of the map that is known, as far as it was noted, drawn with at most so many cells, and never
  /// more than most_drawn_cells: k x k cells of the map, with the least k that will do, make one. It is
  /// occupied where one of them is, else free where one of them is, and known when the first of them was. At
  /// most 500 steps of time. O(cells of the map).
  [[nodiscard]] ReportMap map(const Grid<std::uint8_t>& occupancy, std::size_t most_cells = 150'000) const;

 private:
  static constexpr float never = std::numeric_limits<float>::infinity();

  void follow(const GridFrame& frame);

  Grid<float> known_s_;  ///< by cell: when it was first known
  double end_s_ = 0.0;
};

}  // namespace outrider
