// best_first: a generic best-first search. Dijkstra, A*, any-angle A* and similar planners are policies of
// it.
//
// A policy defines the states, the neighbours of a state, and the parent through which a neighbour is
// reached:
//
//   struct Policy {
//     using Cost = ...;                        // cost of a path; has operator<; Cost{} is zero
//     std::size_t states() const;              // states are 0 .. states() - 1
//     State start() const;
//     bool is_goal(State s) const;
//     Cost estimate(State s) const;            // h, a lower bound of the cost to the goal
//     double value(const Cost& cost) const;    // a number that increases with the cost
//     double priority(const Cost& g, const Cost& h) const;  // f
//     double tie(const Cost& g) const;         // optional: of equal f the largest comes first; else value(g)
//     static constexpr bool reopens = true;    // optional: opens a closed state again for a smaller g
//     void settle(State s);                    // may change the label of s just before s is closed
//     void expand(State s, Relax& relax);      // relax(neighbour, parent, g, h) for each neighbour; h may be
//                                              // a function that returns it, called only when it is needed
//   };
//
// The order of expansion is least f, then largest g (or tie()), then least state, so the result is the same
// on every machine. A closed state is never opened again unless the policy reopens. So if h is consistent and
// settle() changes nothing, the cost found is optimal; with reopening it suffices that h is a lower bound.
// Only states that the search reaches are touched. O((states + moves) log states). Faults: no_path if all
// states reachable from the start are closed; budget_exhausted; cancelled. Sources: Hart, Nilsson and Raphael
// (1968); Nash et al. (2007) for the choice of parent.
#pragma once

#include <type_traits>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/trace.hpp"
#include "outrider/search/labels.hpp"
#include "outrider/search/queue.hpp"

namespace outrider {

/// The memory of best_first() for one type of cost. Reuse it between searches to avoid allocations.
template <class Cost>
struct SearchMemory {
  Labels<Cost> labels;
  BucketQueue queue;
};

template <class Policy>
double tie_of(const Policy& policy, const typename Policy::Cost& g) {
  if constexpr (requires { policy.tie(g); }) {
    return policy.tie(g);
  } else {
    return policy.value(g);
  }
}

template <class Policy>
constexpr bool reopens_closed() {
  if constexpr (requires { Policy::reopens; }) {
    return Policy::reopens;
  } else {
    return false;
  }
}

/// Returns an estimate, or calls the function that gives it.
template <class Estimate>
auto value_of(const Estimate& h) {
  if constexpr (std::is_invocable_v<const Estimate&>) {
    return h();
  } else {
    return h;
  }
}

/// Searches a path and returns the goal state. `memory` is a SearchMemory or a CompactMemory; its labels hold
/// the path, see path_to().
template <class Policy, class Memory>
Outcome<State> best_first(Policy& policy, Memory& memory, BudgetMeter& meter, Trace* trace = nullptr) {
  using Cost = typename Policy::Cost;
  auto& labels = memory.labels;
  BucketQueue& queue = memory.queue;
  const auto relax = [&](State s, State parent, const Cost& g, const auto& h) {
    const auto met = [&] {
      if (trace != nullptr) trace->open(s);
    };
    if (labels.template offer<reopens_closed<Policy>()>(s, parent, g, met))
      queue.push(policy.priority(g, value_of(h)), tie_of(policy, g), s);
  };

  const Cost from_start = policy.estimate(policy.start());
  labels.begin(policy.states());
  queue.begin(policy.priority(Cost{}, from_start));
  if (trace != nullptr) trace->open(policy.start());
  labels.open(policy.start(), policy.start(), Cost{});
  queue.push(policy.priority(Cost{}, from_start), tie_of(policy, Cost{}), policy.start());
  QueueEntry entry;
  while (queue.pop(entry)) {
    if (labels.closed(entry.state)) continue;
    if (!meter.spend()) return meter.refusal();
    policy.settle(entry.state);
    labels.close(entry.state);
    if (trace != nullptr) {
      trace->record({entry.state, labels.parent(entry.state), entry.f, policy.value(labels.g(entry.state)),
                     policy.value(policy.estimate(entry.state))});
    }
    if (policy.is_goal(entry.state)) return entry.state;
    policy.expand(entry.state, relax);
  }
  return fault(FaultCode::no_path, "nothing joins the start and the goal");
}

/// Returns the states on the path from the start to `last`, by following the parents.
template <class AnyLabels>
std::vector<State> path_to(State last, const AnyLabels& labels) {
  std::vector<State> path{last};
  while (labels.parent(path.back()) != path.back()) path.push_back(labels.parent(path.back()));
  return {path.rbegin(), path.rend()};
}

}  // namespace outrider
