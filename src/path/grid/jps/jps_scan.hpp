// Scans for jump points on the bits of a map.
//
// `emit(cell, direction)` receives each jump point that a scan finds, with the straight direction of arrival.
#pragma once

#include "jps_map.hpp"

namespace outrider::jump {

/// Scans the straight run from a cell; `ahead` cells of it are known to be free and without a turn. Returns
/// how far the run is free, at most up to the jump point.
template <class Emit>
std::int32_t scan_straight(const Map& map, Cell c, unsigned d, std::int32_t ahead, Emit& emit) {
  const std::int32_t p = map.position(d, c);
  const Stop stop = scan(map.line(d, c), map.lines[d].stride, p + ahead);
  if (stop.sides == 0) return stop.position - p - 1;
  emit(map.cell(d, c, stop.position), d);
  return stop.position - p;
}

/// The lines along one of the two straight directions of a diagonal run, with three moving windows of bits.
struct Side {
  const std::uint64_t* line;  // through the present cell
  std::ptrdiff_t step;        // to the line of the next cell
  std::int32_t position;      // position of the first bit of the windows
  std::uint64_t blocked, ahead, ends_behind = 0, ends_here, ends_ahead;

  Side(const Map& map, unsigned d, Cell c, bool up)
      : line(map.line(d, c)),
        step(up ? map.lines[d].stride : -map.lines[d].stride),
        position(map.position(d, c)),
        blocked(window(line, position)),
        ahead(window(line + step, position)),
        ends_here(ends(blocked)),
        ends_ahead(ends(ahead)) {}

  void advance() {
    line += step;
    ends_behind = ends_here;
    ends_here = ends_ahead;
    blocked = ahead;
    ahead = window(line + step, position);
    ends_ahead = ends(ahead);
  }
  /// Returns true if the diagonal step to bit i of the next line meets a blocked cell.
  [[nodiscard]] bool bars(unsigned i) const {
    return (((blocked >> i) & 1U) | ((ahead >> (i - 1)) & 3U)) != 0;
  }
  /// Finds where the straight run from bit i stops within the windows; 0 if it does not.
  [[nodiscard]] std::uint64_t stop(unsigned i) const {
    const std::uint64_t stops = (ends_behind | ends_ahead | blocked) & (~std::uint64_t{1} << i);
    return stops & (~stops + 1);
  }

  /// Scans the straight run in direction d from bit i, which is the cell c.
  template <class Emit>
  void scan_from(const Map& map, Cell c, unsigned d, unsigned i, Emit& emit) const {
    const std::uint64_t found = stop(i);
    if (found == 0) {
      scan_straight(map, c, d, 63 - static_cast<std::int32_t>(i), emit);
    } else if ((found & blocked) == 0) {
      emit(map.cell(d, c, position + std::countr_zero(found)), d);
    }
  }
};

/// Scans the straight runs beside a diagonal one, whose own first cell is not scanned from, for that many
/// steps at most. Returns the number of legal steps.
template <class Emit>
int scan_diagonal(const Map& map, Cell c, unsigned h, unsigned v, int most_steps, Emit& emit) {
  constexpr int block = 32;
  const int dx = h == east ? 1 : -1, dy = v == north ? 1 : -1;
  for (int steps = 0; steps < most_steps; steps += block) {
    const Cell begin{c.x + steps * dx, c.y + steps * dy};
    Side rows(map, h, begin, v == north);
    Side columns(map, v, begin, h == east);
    for (int i = 1; i <= std::min(block, most_steps - steps); ++i) {
      if (rows.bars(static_cast<unsigned>(i))) return steps + i - 1;
      rows.advance();
      columns.advance();
      const Cell here{begin.x + i * dx, begin.y + i * dy};
      rows.scan_from(map, here, h, static_cast<unsigned>(i), emit);
      columns.scan_from(map, here, v, static_cast<unsigned>(i), emit);
    }
  }
  return most_steps;
}

}  // namespace outrider::jump
