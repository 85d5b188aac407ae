#include "outrider/path/grid/line_of_sight.hpp"

#include <cstdlib>

namespace outrider {
namespace {

constexpr std::uint8_t blocked_bit = GridMap::blocked_bit;

/// Tests a leg between centres: every cell on it, and both cells beside a corner that it passes exactly.
bool visible_between_centres(const GridMap& ground, Cell from, Cell to) {
  const std::int64_t dx = std::abs(to.x - from.x), dy = std::abs(to.y - from.y);
  const std::ptrdiff_t step_x = to.x > from.x ? 1 : -1;
  const std::ptrdiff_t step_y = (to.y > from.y ? 1 : -1) * static_cast<std::ptrdiff_t>(ground.stride);
  const std::uint8_t* cell = ground.marks.data() + ground.index(from);
  const std::uint8_t* const last = ground.marks.data() + ground.index(to);
  std::int64_t ahead = dy - dx;  // sign: which side of the next corner the leg passes
  unsigned seen = *cell;
  while (cell != last && (seen & blocked_bit) == 0) {
    if (ahead < 0) {
      cell += step_x;
      ahead += 2 * dy;
    } else if (ahead > 0) {
      cell += step_y;
      ahead -= 2 * dx;
    } else {
      seen |= static_cast<unsigned>(cell[step_x] | cell[step_y]);
      cell += step_x + step_y;
      ahead += 2 * (dy - dx);
    }
    seen |= *cell;
  }
  return (seen & blocked_bit) == 0;
}

/// Tests a leg along a lattice line: each unit needs a free cell on one side, and there is no pinch between
/// the ends.
bool visible_along_border(const GridMap& ground, Cell from, std::ptrdiff_t step, std::ptrdiff_t beside,
                          int count, bool upwards) {
  const std::uint8_t* vertex = ground.marks.data() + ground.index(from);
  for (int i = 0; i < count; ++i, vertex += step) {
    if (i > 0 && (*vertex & GridMap::pinch_bit) != 0) return false;
    const std::uint8_t* cell = upwards ? vertex : vertex + step;  // the cell on one side of this unit
    if ((cell[0] & cell[-beside] & blocked_bit) != 0) return false;
  }
  return true;
}

/// Tests a leg between corners that is not along a lattice line: every cell that it crosses, and no pinch
/// between the ends.
bool visible_between_corners(const GridMap& ground, Cell from, Cell to) {
  const std::int64_t dx = std::abs(to.x - from.x), dy = std::abs(to.y - from.y);
  const bool right = to.x > from.x, up = to.y > from.y;
  const std::ptrdiff_t step_x = right ? 1 : -1;
  const std::ptrdiff_t step_y = (up ? 1 : -1) * static_cast<std::ptrdiff_t>(ground.stride);
  const auto first_cell = [&](Cell v) { return Cell{right ? v.x : v.x - 1, up ? v.y : v.y - 1}; };
  const std::uint8_t* cell = ground.marks.data() + ground.index(first_cell(from));
  const std::uint8_t* const last = ground.marks.data() + ground.index(first_cell(to)) - step_x - step_y;
  std::int64_t ahead = dy - dx;
  while ((*cell & blocked_bit) == 0) {
    if (cell == last) return true;
    if (ahead < 0) {
      cell += step_x;
      ahead += dy;
    } else if (ahead > 0) {
      cell += step_y;
      ahead -= dx;
    } else {
      if ((cell[step_x] & cell[step_y] & blocked_bit) != 0) return false;
      cell += step_x + step_y;
      ahead += dy - dx;
    }
  }
  return false;
}

}  // namespace

bool visible(const GridMap& ground, Cell from, Cell to) {
  if (ground.model == GridModel::cells) return visible_between_centres(ground, from, to);
  const auto stride = static_cast<std::ptrdiff_t>(ground.stride);
  if (from.y == to.y) {
    const bool right = to.x > from.x;
    return visible_along_border(ground, from, right ? 1 : -1, stride, std::abs(to.x - from.x), right);
  }
  if (from.x == to.x) {
    const bool up = to.y > from.y;
    return visible_along_border(ground, from, up ? stride : -stride, 1, std::abs(to.y - from.y), up);
  }
  return visible_between_corners(ground, from, to);
}

}  // namespace outrider
