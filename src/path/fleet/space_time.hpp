// The search of one robot in space and time: from its start to its goal, where it can stay for good.
#pragma once

#include <algorithm>
#include <limits>

#include "fleet_query.hpp"
#include "outrider/search/best_first.hpp"

namespace outrider::fleet {

/// A policy of best_first(). The rules say what is forbidden:
///
///   struct Rules {
///     int last_step() const;                            // after it nothing changes any more
///     bool vertex_blocked(State s, int step) const;     // being in s at that step
///     bool edge_blocked(State from, State to, int step) const;  // going there, to arrive at that step
///     bool can_stay(State goal, int step) const;        // from that step on for good
///   };
///
/// A state is a cell at a step; all steps after last_step() are one, so there are finitely many states.
template <class Rules>
struct SpaceTimePolicy {
  using Cost = int;  // steps

  const Query& query;
  std::size_t robot;
  const Rules& rules;
  Labels<int>& labels;
  std::size_t cells = query.ground.marks.size();
  int layers = rules.last_step() + 2;

  [[nodiscard]] std::size_t states() const { return cells * static_cast<std::size_t>(layers); }
  [[nodiscard]] State state(State cell, int step) const {
    return static_cast<State>(cells * static_cast<std::size_t>(std::min(step, layers - 1)) + cell);
  }
  [[nodiscard]] State cell(State s) const { return static_cast<State>(s % cells); }
  [[nodiscard]] State start() const { return query.starts[robot]; }
  [[nodiscard]] bool is_goal(State s) const {
    return cell(s) == query.goals[robot] && rules.can_stay(cell(s), labels.g(s));
  }
  [[nodiscard]] int estimate(State s) const { return static_cast<int>(query.steps[robot][cell(s)]); }
  [[nodiscard]] static double value(int cost) { return cost; }
  [[nodiscard]] static double priority(int g, int h) { return g + h; }
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    const State from = cell(s);
    const int step = labels.g(s) + 1;
    query.for_each_step(from, [&](State to) {
      if (rules.vertex_blocked(to, step) || rules.edge_blocked(from, to, step)) return;
      if (query.steps[robot][to] == unreachable) return;
      relax(state(to, step), s, step, static_cast<int>(query.steps[robot][to]));
    });
  }
};

/// Returns the shortest track of a robot under the rules. Faults: those of best_first(); budget_exhausted if
/// there are too many states.
template <class Rules>
Outcome<Track> track_of(const Query& query, std::size_t robot, const Rules& rules, SearchMemory<int>& memory,
                        BudgetMeter& meter) {
  SpaceTimePolicy<Rules> policy{query, robot, rules, memory.labels};
  if (policy.states() > std::numeric_limits<State>::max() / 8) {
    return fault(FaultCode::budget_exhausted,
                 "the robots take too many steps on a grid of that size; take lacam");
  }
  auto found = best_first(policy, memory, meter);
  if (!found) return pass_on(found);
  Track track;
  for (const State s : path_to(*found, memory.labels)) track.push_back(policy.cell(s));
  return track;
}

}  // namespace outrider::fleet
