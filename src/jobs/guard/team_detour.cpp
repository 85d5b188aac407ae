#include "team_detour.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

class DetourSearch {
 public:
  DetourSearch(const GuardProblem& problem, const FiringMap& firing_map, const std::vector<Vec2>& standing,
               double gap_m)
      : problem_(problem), firing_map_(firing_map), standing_(standing), gap_m_(gap_m) {}

  [[nodiscard]] bool is_free(Vec2 a, Vec2 b) const {
    const Segment leg{a, b};
    return std::ranges::all_of(standing_, [&](Vec2 other) { return distance(other, leg) >= gap_m_; }) &&
           firing_map_.ground.segment_free(leg, problem_.robot.radius_m);
  }

  /// The places of a chain of cells, with both ends; none if there is no chain.
  [[nodiscard]] std::vector<Vec2> chain(Vec2 from, Vec2 to) const {
    const GridFrame& frame = firing_map_.frame;
    const Cell first = frame.cell_at(from), last = frame.cell_at(to);
    if (!frame.contains(first) || !frame.contains(last)) return {};
    const std::size_t start = frame.index(first), goal = frame.index(last);
    const auto place = [&](std::size_t cell) {
      if (cell == start) return from;
      return cell == goal ? to : frame.centre(frame.cell(cell));
    };
    std::vector<double> length_m(frame.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> before(frame.size(), start);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    length_m[start] = 0.0;
    open.emplace(distance(from, to), start);
    while (!open.empty() && open.top().second != goal) {
      const auto [estimate_m, cell] = open.top();
      open.pop();
      if (estimate_m > length_m[cell] + distance(place(cell), to) + 1e-9) continue;
      const Cell here = frame.cell(cell);
      for (int k = 0; k < 9; ++k) {
        const Cell there{here.x + k % 3 - 1, here.y + k / 3 - 1};
        if (!frame.contains(there)) continue;
        const std::size_t next = frame.index(there);
        const double way_m = length_m[cell] + distance(place(cell), place(next));
        if (way_m >= length_m[next] || (next != goal && firing_map_.reachable[next] == 0) ||
            !is_free(place(cell), place(next)))
          continue;
        length_m[next] = way_m;
        before[next] = cell;
        open.emplace(way_m + distance(place(next), to), next);
      }
    }
    if (open.empty()) return {};
    std::vector<Vec2> places{to};
    for (std::size_t cell = goal; cell != start; cell = before[cell]) places.push_back(place(before[cell]));
    std::ranges::reverse(places);
    return places;
  }

 private:
  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  const std::vector<Vec2>& standing_;
  double gap_m_;
};

}  // namespace

std::optional<std::vector<Vec2>> way_around(const GuardProblem& problem, const FiringMap& firing_map,
                                            Vec2 from, Vec2 to, const std::vector<Vec2>& standing,
                                            double gap_m) {
  const DetourSearch search(problem, firing_map, standing, gap_m);
  if (search.is_free(from, to)) return std::vector<Vec2>{from, to};
  const std::vector<Vec2> chain = search.chain(from, to);
  if (chain.size() < 2) return std::nullopt;
  std::vector<Vec2> way{chain.front()};
  for (std::size_t at = 0; at + 1 < chain.size();) {
    std::size_t next = chain.size() - 1;
    while (next > at + 1 && !search.is_free(chain[at], chain[next])) --next;
    way.push_back(chain[next]);
    at = next;
  }
  return way;
}

}  // namespace outrider
