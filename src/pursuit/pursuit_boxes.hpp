// The boxes of a pursuit: for each second a rectangle that holds every cell that matters.
//
// In second s the robot is at most s cells away from its start, and must still come to a cell of the target
// in time. So it is in the rectangle of its start grown by s, and in the rectangle around the cells of the
// target in later seconds, each grown by the seconds until then. Everything outside does not matter. The sum
// of the areas is the work of a sweep over layers, known before it begins.
#pragma once

#include <algorithm>
#include <cstdint>
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

/// Returns the box of each second from 0 to the last of `catches`, which are the seconds of possible catches
/// in order. The robot is in cell `from` at second `from_s`; boxes of earlier seconds are empty.
inline std::vector<CellBox> pursuit_boxes(const PursuitField& field, std::span<const int> catches,
                                          CellIndex from, int from_s) {
  const CellBox map = field.box();
  const Cell start = field.cell(from);
  std::vector<CellBox> boxes(static_cast<std::size_t>(catches.back()) + 1);
  CellBox ahead;
  auto next = catches.rbegin();
  for (int s = catches.back(); s >= from_s; --s) {
    const auto at = static_cast<std::size_t>(s);
    if (!ahead.empty()) ahead = common(ahead.grown(1), map);
    if (next != catches.rend() && *next == s) ahead = around(ahead, field.cell(field.target[at])), ++next;
    boxes[at] = common(ahead, CellBox{start, start}.grown(s - from_s));
  }
  return boxes;
}

}  // namespace outrider
