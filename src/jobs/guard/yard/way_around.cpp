#include "yard/way_around.hpp"

#include <algorithm>

#include "outrider/geometry/convex.hpp"
#include "outrider/search/best_first.hpp"

namespace outrider {
namespace {

/// The ground on which the robot may drive while others stand.
class FreeLegs {
 public:
  FreeLegs(const GuardProblem& problem, const FiringMap& firing_map, const std::vector<Vec2>& standing,
           double gap_m)
      : problem_(problem), firing_map_(firing_map), standing_(standing), gap_m_(gap_m) {}

  [[nodiscard]] bool is_free(Vec2 a, Vec2 b) const {
    const Segment leg{a, b};
    return std::ranges::all_of(standing_, [&](Vec2 other) { return distance(other, leg) >= gap_m_; }) &&
           firing_map_.ground.segment_free(leg, problem_.robot.radius_m);
  }

 private:
  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  const std::vector<Vec2>& standing_;
  double gap_m_;
};

/// A policy of best_first(): chains of neighbouring reachable cells, shortest first. The first and the last
/// cell stand for the two places.
class Chains {
 public:
  using Cost = double;

  Chains(const FiringMap& firing_map, const FreeLegs& legs, const Labels<Cost>& labels, Vec2 from, Vec2 to)
      : firing_map_(firing_map), legs_(legs), labels_(labels), from_(from), to_(to) {}

  [[nodiscard]] std::size_t states() const { return firing_map_.frame.size(); }
  [[nodiscard]] State start() const { return state_at(firing_map_.frame.cell_at(from_)); }
  [[nodiscard]] State goal() const { return state_at(firing_map_.frame.cell_at(to_)); }
  [[nodiscard]] bool is_goal(State s) const { return s == goal(); }
  [[nodiscard]] Cost estimate(State s) const { return distance(place(s), to_); }
  [[nodiscard]] static double value(Cost cost) { return cost; }
  [[nodiscard]] static double priority(Cost g, Cost h) { return g + h; }
  static void settle(State) {}

  [[nodiscard]] Vec2 place(State s) const {
    if (s == start()) return from_;
    return s == goal() ? to_ : firing_map_.place(s);
  }

  template <class Relax>
  void expand(State s, const Relax& relax) const {
    const Cell here = firing_map_.frame.cell(s);
    for (int k = 0; k < 9; ++k) {
      const Cell there{here.x + k % 3 - 1, here.y + k / 3 - 1};
      if (k == 4 || !firing_map_.frame.contains(there)) continue;
      const State next = state_at(there);
      if ((next != goal() && firing_map_.reachable[next] == 0) || !legs_.is_free(place(s), place(next)))
        continue;
      relax(next, s, labels_.g(s) + distance(place(s), place(next)), estimate(next));
    }
  }

 private:
  [[nodiscard]] State state_at(Cell cell) const { return static_cast<State>(firing_map_.frame.index(cell)); }

  const FiringMap& firing_map_;
  const FreeLegs& legs_;
  const Labels<Cost>& labels_;
  Vec2 from_, to_;
};

}  // namespace

std::optional<std::vector<Vec2>> way_around(const GuardProblem& problem, const FiringMap& firing_map,
                                            Vec2 from, Vec2 to, const std::vector<Vec2>& standing,
                                            double gap_m, const Budget& budget) {
  const FreeLegs legs(problem, firing_map, standing, gap_m);
  if (legs.is_free(from, to)) return std::vector<Vec2>{from, to};
  const GridFrame& frame = firing_map.frame;
  if (!frame.contains(frame.cell_at(from)) || !frame.contains(frame.cell_at(to))) return std::nullopt;
  SearchMemory<double> memory;
  Chains chains(firing_map, legs, memory.labels, from, to);
  BudgetMeter meter(budget);
  const auto goal = best_first(chains, memory, meter);
  if (!goal) return std::nullopt;
  const std::vector<State> chain = path_to(*goal, memory.labels);
  std::vector<Vec2> way{from};
  for (std::size_t at = 0; at + 1 < chain.size();) {
    std::size_t next = chain.size() - 1;
    while (next > at + 1 && !legs.is_free(chains.place(chain[at]), chains.place(chain[next]))) --next;
    way.push_back(chains.place(chain[next]));
    at = next;
  }
  return way;
}

}  // namespace outrider
