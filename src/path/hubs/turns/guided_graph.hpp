// A graph of turns with landmarks, for a search that is led by them: the index of a map whose hub labels do
// not fit.
//
// A landmark is a turn from which the length of the shortest path to every turn is known. By the triangle
// inequality, no path from a turn to the goal is shorter than the difference of their lengths from a
// landmark. Landmarks near the border of the map, in all directions, lie behind most goals, where the
// difference is nearly the length itself. Thread rule: read-only after construction.
//
// A `Metric` says how lengths are kept:
//   Cost                    length of a path, as best_first.hpp asks for it
//   static far()            infinite Cost, where no path leads
//   static between(a, b)    Cost of a leg
//   static add(cost, leg)   their sum
//   static cells(cost)      the length as a number of cells
//   Stored                  length from a landmark; none() where no path leads
//   static stored(cost)     a length as Stored
//   static known(stored)    false for none()
//   static length(stored)   as Cost, perhaps rounded
//   static lead(a, b)       lower bound of the length between places at the lengths a and b from a landmark
//
// Source: Goldberg and Harrelson, Computing the shortest path: A* search meets graph theory (2005).
#pragma once

#include <array>
#include <functional>
#include <queue>
#include <span>
#include <utility>

#include "hubs/stored_array.hpp"
#include "turn_graph.hpp"

namespace outrider::hub_labelling {

/// Number of landmarks at most.
inline constexpr std::size_t most_landmarks = 32;

template <class Metric>
struct GuidedGraph {
  /// A length for each landmark; none() beyond the last one.
  using Lengths = std::array<typename Metric::Stored, most_landmarks>;

  StoredArray<Cell> at;              ///< by turn
  StoredArray<std::uint32_t> first;  ///< of each turn, the first edges on its level and its upright side; one
                                     ///< more at the end
  StoredArray<std::uint32_t> to;     ///< by edge
  StoredArray<std::uint32_t> component;  ///< by turn: equal where a path leads from one to the other
  StoredArray<std::uint32_t> landmarks;  ///< turns
  StoredArray<Lengths> lengths;          ///< by turn
  std::vector<Winding> windings;         ///< by turn; none if any edge may follow any other

  [[nodiscard]] std::size_t turns() const { return at.size(); }
  [[nodiscard]] std::size_t memory() const {
    return at.memory() + first.memory() + to.memory() + component.memory() + lengths.memory() +
           windings.capacity() * sizeof(Winding);
  }
  /// Calls visit(turn) for each turn to which a path that came along `came` may go on.
  template <class Visit>
  void onward(std::uint32_t turn, Cell came, Visit visit) const {
    const std::size_t begin = 2 * std::size_t{turn};
    if (windings.empty()) {
      for (std::uint32_t e = first[begin]; e < first[begin + 2]; ++e) visit(to[e]);
      return;
    }
    const Winding winding = windings[turn];
    const Winding::Side side = winding.side(came);
    const std::size_t fan = begin + (side == Winding::Side::level ? 0 : 1);
    for (std::uint32_t e = first[fan]; e < first[fan + 1]; ++e) {
      const Cell way{at[to[e]].x - at[turn].x, at[to[e]].y - at[turn].y};
      if (winding.farther(side, came, way) > 0) return;
      visit(to[e]);
    }
  }
};

/// Returns true if a search in the graph is probably faster than one without an index: where a turn leads to
/// 40 others or fewer on average. Where blocked cells stand far apart, most of them lead to more.
bool worth_guiding(const TurnGraph& graph);

/// Returns the number of the component of each turn, counted by their first turns.
std::vector<std::uint32_t> components_of(const TurnGraph& graph);

/// Returns the turns of the largest component that are farthest from its middle, one in each of 32
/// directions.
std::vector<std::uint32_t> landmarks_of(const std::vector<Cell>& at,
                                        const std::vector<std::uint32_t>& component);

/// Returns the graph without the lengths from its landmarks. O(edges).
template <class Metric>
GuidedGraph<Metric> with_landmarks(const TurnGraph& graph, std::vector<Cell> at) {
  std::vector<std::uint32_t> first{0U}, to, component = components_of(graph);
  for (const Fan<TurnGraph::Edge>& fan : graph.edges) {
    for (const auto* side : {&fan.level, &fan.upright}) {
      for (const TurnGraph::Edge& edge : *side) to.push_back(edge.to);
      first.push_back(static_cast<std::uint32_t>(to.size()));
    }
  }
  GuidedGraph<Metric> guided;
  guided.landmarks = StoredArray(landmarks_of(at, component));
  guided.at = StoredArray(std::move(at));
  guided.first = StoredArray(std::move(first));
  guided.to = StoredArray(std::move(to));
  guided.component = StoredArray(std::move(component));
  guided.windings = graph.windings;
  return guided;
}

/// The first leg of a path from a landmark, which leads to a turn.
template <class Metric>
struct FirstLeg {
  std::uint32_t turn = 0;
  Cell way;  ///< {0, 0}: any edge may follow
  typename Metric::Cost length{};
};

/// Returns the lengths of the shortest paths that begin with one of the legs, by turn at which they arrive
/// such that they may go on; far() where none arrives. O(edges log edges).
template <class Metric>
std::vector<typename Metric::Cost> lengths_from(const TurnGraph& graph, const GuidedGraph<Metric>& guided,
                                                std::span<const FirstLeg<Metric>> legs) {
  using Cost = typename Metric::Cost;
  using Open = std::pair<double, std::uint32_t>;
  std::vector<Cost> lengths(graph.turns(), Metric::far());
  std::vector<Cell> came(graph.turns());
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto reach = [&](std::uint32_t turn, const Cost& length, Cell way) {
    if (!(length < lengths[turn])) return;
    lengths[turn] = length;
    came[turn] = way;
    open.emplace(Metric::cells(length), turn);
  };
  for (const FirstLeg<Metric>& leg : legs) reach(leg.turn, leg.length, leg.way);
  while (!open.empty()) {
    const auto [cells, turn] = open.top();
    open.pop();
    if (Metric::cells(lengths[turn]) < cells) continue;
    const Cost so_far = lengths[turn];
    graph.onward(turn, came[turn], [&, from = turn](const TurnGraph::Edge& edge) {
      reach(edge.to, Metric::add(so_far, Metric::between(guided.at[from], guided.at[edge.to])), edge.way);
    });
  }
  return lengths;
}

}  // namespace outrider::hub_labelling
