// The one best-first loop. Dijkstra, A*, free-direction A* and their kin are policies of it.
//
// A policy says what the states are, what a neighbour is and through which parent it is reached:
//
//   struct Policy {
//     using Cost = ...;                        // of a path; has < and a default value of nothing
//     std::size_t states() const;              // states are 0 .. states() - 1
//     State start() const;
//     bool is_goal(State s) const;
//     Cost estimate(State s) const;            // h, a lower bound of the cost to the goal
//     double value(const Cost& cost) const;    // in order of cost
//     double priority(const Cost& g, const Cost& h) const;  // f
//     void settle(State s);                    // last word on the label of s before it is closed
//     void expand(State s, Relax& relax);      // relax(neighbour, parent, g, h) for each neighbour
//   };
//
// Order: least f, then largest g, then least state: the answer is the same everywhere. A closed
// state is never opened again, so with a consistent h and settle() idle the cost found is least.
// Touches only the states that it meets. O((states + moves) log states). Faults: no_path when all
// that the start reaches was closed; budget_exhausted; cancelled.
// Source: Hart, Nilsson and Raphael (1968); the frame with a choice of parent, Nash et al. (2007).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/trace.hpp"
#include "outrider/search/labels.hpp"
#include "outrider/search/queue.hpp"

namespace outrider {

/// What best_first() keeps between searches, for one type of cost.
template <class Cost>
struct SearchMemory {
  Labels<Cost> labels;
  BucketQueue queue;
};

/// The goal state; the path to it stands in the labels.
template <class Policy>
Outcome<State> best_first(Policy& policy, SearchMemory<typename Policy::Cost>& memory, BudgetMeter& meter,
                          Trace* trace = nullptr) {
  using Cost = typename Policy::Cost;
  Labels<Cost>& labels = memory.labels;
  BucketQueue& queue = memory.queue;
  const auto relax = [&](State s, State parent, const Cost& g, const Cost& h) {
    const bool known = labels.known(s);
    if (known && (labels.closed(s) || !(g < labels.g(s)))) return;
    if (trace != nullptr && !known) trace->open(s);
    labels.open(s, parent, g);
    queue.push(policy.priority(g, h), policy.value(g), s);
  };

  const Cost from_start = policy.estimate(policy.start());
  labels.begin(policy.states());
  queue.begin(policy.priority(Cost{}, from_start));
  if (trace != nullptr) trace->open(policy.start());
  labels.open(policy.start(), policy.start(), Cost{});
  queue.push(policy.priority(Cost{}, from_start), policy.value(Cost{}), policy.start());
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

/// The states from the start to `last`, by their parents.
template <class Cost>
std::vector<State> path_to(State last, const Labels<Cost>& labels) {
  std::vector<State> path{last};
  while (labels.parent(path.back()) != path.back()) path.push_back(labels.parent(path.back()));
  return {path.rbegin(), path.rend()};
}

}  // namespace outrider
