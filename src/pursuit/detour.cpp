#include "detour.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace outrider {
namespace {

/// The rest of a relaxed way.
struct Rest {
  int steps = -1;  // not yet known
  int second = 0;  // of the catch
  std::uint64_t cost = 0;
};

/// Finds the rest from a cell, and from all cells on the way, from those that are known.
const Rest& find_rest(const PursuitField& field, const Relaxation& backward, CellIndex from,
                      std::vector<Rest>& rests) {
  std::vector<CellIndex> way;
  CellIndex at = from;
  for (; rests[at].steps < 0; at = backward.next(at)) {
    if (backward.next(at) == at) {
      rests[at] = {0, backward.catch_at(at), 0};
      break;
    }
    way.push_back(at);
  }
  for (; !way.empty(); way.pop_back()) {
    const Rest& next = rests[at];
    at = way.back();
    rests[at] = {next.steps + 1, next.second, next.cost + field.costs[at]};
  }
  return rests[from];
}

}  // namespace

std::optional<TimedWay> best_detour(const PursuitField& field, const ForwardBound& forward,
                                    const Relaxation& backward) {
  std::vector<Rest> rests(field.size());
  std::pair<std::uint64_t, CellIndex> best{unreachable, 0};
  TimedWay way;
  for (CellIndex i = 0; i < field.size(); ++i) {
    if (!forward.reached(i) || !backward.reached(i)) continue;
    const Rest& rest = find_rest(field, backward, i, rests);
    const int waits = rest.second - field.start_s - forward.steps(i) - rest.steps;
    if (waits < 0) continue;
    const std::uint64_t cost =
        forward.cost(i) + rest.cost + static_cast<std::uint64_t>(waits) * field.costs[i];
    best = std::min(best, {cost, i});
  }
  if (best.first == unreachable) return std::nullopt;
  for (CellIndex i = best.second; i != field.start; i = forward.before(i)) way.cells.push_back(i);
  way.cells.push_back(field.start);
  std::reverse(way.cells.begin(), way.cells.end());
  for (CellIndex i = best.second; backward.next(i) != i; i = backward.next(i))
    way.cells.push_back(backward.next(i));
  way.second = rests[best.second].second;
  return way;
}

}  // namespace outrider
