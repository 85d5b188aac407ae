// A* over the turns of a GuidedGraph, led by its landmarks.
//
// The states are the turns, the start and the goal. The start leads to the turns that it reaches, and those
// that reach the goal lead there. The bound of a turn is the largest of the leg to the goal and of the
// differences of lengths from the landmarks. These may be rounded, so states may open again.
#pragma once

#include <algorithm>
#include <limits>

#include "guided_graph.hpp"
#include "hubs/hub_index.hpp"
#include "outrider/search/best_first.hpp"

namespace outrider::hub_labelling {

/// One end of a query: the place, and the turns that it reaches by a leg.
struct GuidedEnd {
  Cell at;
  std::vector<std::uint32_t> turns;
  bool passable = true;  ///< a path may pass through the place, so the triangle inequality holds there
};

/// Number of landmarks that a search uses.
inline constexpr std::size_t used_landmarks = 8;

/// Lengths of the shortest paths from the landmarks to an end; far() where there is none.
template <class Metric>
using EndLengths = std::array<typename Metric::Cost, most_landmarks>;

/// Returns the lengths of the shortest paths from the landmarks to an end, over the turns that it reaches.
template <class Metric>
EndLengths<Metric> lengths_over(const GuidedGraph<Metric>& graph, const GuidedEnd& end) {
  EndLengths<Metric> lengths;
  lengths.fill(Metric::far());
  for (const std::uint32_t turn : end.turns) {
    const auto leg = Metric::between(graph.at[turn], end.at);
    for (std::size_t k = 0; k < graph.landmarks.size(); ++k) {
      const auto stored = graph.lengths[turn][k];
      if (!Metric::known(stored)) continue;
      const auto length = Metric::add(Metric::length(stored), leg);
      if (length < lengths[k]) lengths[k] = length;
    }
  }
  return lengths;
}

/// Memory of searches in one graph. A value that holds for one query carries the number of that query.
template <class Metric>
struct GuidedMemory {
  struct OfTurn {
    std::uint32_t query_of_bound = 0, query_of_leg = 0;
    typename Metric::Cost bound{};
    typename Metric::Cost leg{};  ///< to the goal
  };
  SearchMemory<typename Metric::Cost> search;
  std::vector<OfTurn> turns;
  std::uint32_t query = 0;
  GuidedEnd start, goal;
  std::vector<Cell> places;  ///< of the path

  void begin(std::size_t count) {
    if (turns.size() != count || query == std::numeric_limits<std::uint32_t>::max()) {
      turns.assign(count, {});
      query = 0;
    }
    ++query;
  }
};

/// The policy of best_first() between the ends in its memory.
template <class Metric>
class GuidedSearch {
 public:
  using Cost = typename Metric::Cost;
  static constexpr bool reopens = true;

  GuidedSearch(const GuidedGraph<Metric>& graph, const EndLengths<Metric>& to_start,
               const EndLengths<Metric>& to_goal, GuidedMemory<Metric>& memory)
      : graph_(graph), memory_(memory) {
    memory.begin(graph.turns());
    for (const std::uint32_t turn : memory.goal.turns) {
      memory.turns[turn].query_of_leg = memory.query;
      memory.turns[turn].leg = Metric::between(graph.at[turn], memory.goal.at);
    }
    choose(to_start, to_goal);
  }

  [[nodiscard]] std::size_t states() const { return graph_.turns() + 2; }
  [[nodiscard]] State start() const { return static_cast<State>(graph_.turns()); }
  [[nodiscard]] State goal() const { return start() + 1; }
  [[nodiscard]] bool is_goal(State s) const { return s == goal(); }
  [[nodiscard]] double value(const Cost& cost) const { return Metric::cells(cost); }
  [[nodiscard]] double priority(const Cost& g, const Cost& h) const {
    return Metric::cells(Metric::add(g, h));
  }
  void settle(State /*s*/) const {}

  [[nodiscard]] Cost estimate(State s) const {
    if (s == goal()) return {};
    if (s == start()) return Metric::between(memory_.start.at, memory_.goal.at);
    auto& turn = memory_.turns[s];
    if (turn.query_of_bound != memory_.query) {
      turn.query_of_bound = memory_.query;
      turn.bound = bound_of(s);
    }
    return turn.bound;
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const auto& labels = memory_.search.labels;
    if (s == start()) {
      for (const std::uint32_t turn : memory_.start.turns)
        relax(turn, s, Metric::between(memory_.start.at, graph_.at[turn]), estimate(turn));
      return;
    }
    const Cost g = labels.g(s);
    const auto& own = memory_.turns[s];
    if (own.query_of_leg == memory_.query) relax(goal(), s, Metric::add(g, own.leg), Cost{});
    const Cell at = graph_.at[s], before = place_of(labels.parent(s));
    graph_.onward(s, {at.x - before.x, at.y - before.y}, [&](std::uint32_t turn) {
      relax(turn, s, Metric::add(g, Metric::between(at, graph_.at[turn])), estimate(turn));
    });
  }

  /// Returns the place of the start or of a turn.
  [[nodiscard]] Cell place_of(State s) const { return s == start() ? memory_.start.at : graph_.at[s]; }

 private:
  struct Landmark {
    std::size_t number = 0;
    Cost to_goal{};
    double lead = 0.0;  ///< bound from the start
  };

  /// Takes the landmarks that bound the length from the start best.
  void choose(const EndLengths<Metric>& to_start, const EndLengths<Metric>& to_goal) {
    std::array<Landmark, most_landmarks> known{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (to_start[k] < Metric::far() && to_goal[k] < Metric::far())
        known[count++] = {k, to_goal[k], Metric::cells(Metric::lead(to_start[k], to_goal[k]))};
    }
    count_ = std::min(count, used_.size());
    std::partial_sort_copy(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(count), used_.begin(),
                           used_.begin() + static_cast<std::ptrdiff_t>(count_),
                           [](const Landmark& a, const Landmark& b) {
                             return a.lead != b.lead ? a.lead > b.lead : a.number < b.number;
                           });
  }

  [[nodiscard]] Cost bound_of(State turn) const {
    Cost bound = Metric::between(graph_.at[turn], memory_.goal.at);
    const auto& lengths = graph_.lengths[turn];
    for (std::size_t i = 0; i < count_; ++i) {
      const auto stored = lengths[used_[i].number];
      if (!Metric::known(stored)) continue;
      const Cost here = Metric::length(stored);
      if (!memory_.goal.passable && !(here < used_[i].to_goal)) continue;
      const Cost lead = Metric::lead(here, used_[i].to_goal);
      if (bound < lead) bound = lead;
    }
    return bound;
  }

  const GuidedGraph<Metric>& graph_;
  GuidedMemory<Metric>& memory_;
  std::array<Landmark, used_landmarks> used_{};
  std::size_t count_ = 0;
};

/// Returns true if a path may lead from one of the turns to one of the others.
template <class Metric>
bool joined(const GuidedGraph<Metric>& graph, const GuidedEnd& start, const GuidedEnd& goal) {
  return std::any_of(start.turns.begin(), start.turns.end(), [&](std::uint32_t a) {
    return std::any_of(goal.turns.begin(), goal.turns.end(),
                       [&](std::uint32_t b) { return graph.component[a] == graph.component[b]; });
  });
}

/// Finds the shortest path that turns between the ends in the memory, whose `places` become its start, its
/// turns and its goal. Returns `no_path` if there is none.
template <class Metric>
Found find_guided(const GuidedGraph<Metric>& graph, const EndLengths<Metric>& to_start,
                  const EndLengths<Metric>& to_goal, GuidedMemory<Metric>& memory, BudgetMeter& meter) {
  if (!joined(graph, memory.start, memory.goal)) return Found::no_path;
  GuidedSearch<Metric> search(graph, to_start, to_goal, memory);
  const auto goal = best_first(search, memory.search, meter);
  if (!goal) return goal.error().code == FaultCode::no_path ? Found::no_path : Found::out_of_budget;
  const auto& labels = memory.search.labels;
  std::vector<Cell>& places = memory.places;
  places.assign(1, memory.goal.at);
  for (State s = *goal; s != search.start();) {
    s = labels.parent(s);
    places.push_back(search.place_of(s));
  }
  std::reverse(places.begin(), places.end());
  return Found::way;
}

}  // namespace outrider::hub_labelling
