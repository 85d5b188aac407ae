// The unknown cells beside a frontier.
#pragma once

#include "outrider/jobs/explore/map/frontier.hpp"

namespace outrider {

/// visit(cell) for each unknown 4-neighbour of each cell of the frontier, some of them more than once.
template <class Visit>
void for_each_unknown_beside(const Frontier& frontier, const Grid<std::uint8_t>& known, Visit visit) {
  const auto row = static_cast<std::uint32_t>(known.frame.width);
  for (const std::uint32_t cell : frontier.cells) {
    for (const std::uint32_t next : {cell - row, cell - 1, cell + 1, cell + row}) {
      if (known.cells[next] == unknown_cell) visit(next);
    }
  }
}

}  // namespace outrider
