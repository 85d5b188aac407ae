#include "field.hpp"

#include <algorithm>

namespace outrider {

PursuitField::PursuitField(const PursuitProblem& problem) {
  const GridFrame& frame = problem.costs->frame;
  stride = static_cast<CellIndex>(frame.width) + 2;
  const std::size_t cells = stride * (static_cast<std::size_t>(frame.height) + 2);
  costs.resize(cells);
  free = CellSet(cells);
  visited = CellSet(cells);
  cheapest = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t* cost = problem.costs->cells.data();
  for (int y = 0; y < frame.height; ++y) {
    CellIndex i = index({0, y});
    for (int x = 0; x < frame.width; ++x, ++i, ++cost) {
      if (*cost >= problem.threshold) continue;
      costs[i] = *cost;
      free.add(i);
      cheapest = std::min(cheapest, *cost);
    }
  }
  start = index(problem.start);
  last_s = problem.last_s() - problem.start_s;
  for (int s = 0; s <= last_s; ++s) {
    target.push_back(index(problem.target[static_cast<std::size_t>(problem.start_s + s)]));
    if (s == 0) continue;
    visited.add(target.back());
    visits_.push_back({target.back(), s});
  }
  std::sort(visits_.begin(), visits_.end(), [](const Visit& a, const Visit& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.second < b.second;
  });
}

int PursuitField::next_visit(CellIndex i, int second) const {
  if (!visited.has(i)) return -1;
  const auto first =
      std::lower_bound(visits_.begin(), visits_.end(), Visit{i, second}, [](const Visit& a, const Visit& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.second < b.second;
      });
  return first != visits_.end() && first->cell == i ? first->second : -1;
}

}  // namespace outrider
