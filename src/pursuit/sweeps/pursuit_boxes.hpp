// The boxes of a pursuit: for each second a rectangle that holds every cell that matters.
//
// In second s the robot is at most s cells away from its start, and must still come to a cell of the target
// in time. So it is in the rectangle of its start grown by s, and in the rectangle around the cells of the
// target in later seconds, each grown by the seconds until then. Everything outside does not matter. The sum
// of the areas is the work of a sweep over layers, known before it begins.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "field.hpp"

namespace outrider {

inline CellBox common(const CellBox& a, const CellBox& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

/// Returns the smallest box around both; `a` may be empty.
inline CellBox around(const CellBox& a, Cell c) {
  if (a.empty()) return {c, c};
  return {{std::min(a.low.x, c.x), std::min(a.low.y, c.y)},
          {std::max(a.high.x, c.x), std::max(a.high.y, c.y)}};
}

/// Returns the box of each second from 0 to `last`, on a map of that box. The robot is in cell `start` at
/// second `start_s`; boxes of earlier seconds are empty. goal(second) is the cell of a possible catch, if
/// there is one.
template <class Goal>
std::vector<CellBox> pursuit_boxes(const CellBox& map, Cell start, int start_s, int last, Goal goal) {
  std::vector<CellBox> boxes(static_cast<std::size_t>(last) + 1);
  CellBox ahead;
  for (int s = last; s >= start_s; --s) {
    if (!ahead.empty()) ahead = common(ahead.grown(1), map);
    if (const std::optional<Cell> cell = goal(s)) ahead = around(ahead, *cell);
    boxes[static_cast<std::size_t>(s)] = common(ahead, CellBox{start, start}.grown(s - start_s));
  }
  return boxes;
}

/// The same for the seconds `catches`, in order, of possible catches.
inline std::vector<CellBox> pursuit_boxes(const PursuitField& field, std::span<const int> catches,
                                          CellIndex from, int from_s) {
  auto next = catches.rbegin();
  return pursuit_boxes(field.box(), field.cell(from), from_s, catches.back(), [&](int s) {
    if (next == catches.rend() || *next != s) return std::optional<Cell>();
    ++next;
    return std::optional(field.cell(field.target[static_cast<std::size_t>(s)]));
  });
}

}  // namespace outrider
