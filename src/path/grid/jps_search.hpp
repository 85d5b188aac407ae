// The common part of jump point search with and without an index: the reached jump points and their queue.
//
// Between a jump point and its parent the path runs along one diagonal and then straight, so its length is
// the octile distance of the two.
#pragma once

#include <cstdint>
#include <limits>

#include "jps_map.hpp"
#include "jps_nodes.hpp"
#include "jps_queue.hpp"
#include "outrider/core/budget.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider::jump {

struct Frontier {
  Nodes nodes;
  Queue queue;
  Cell goal;          ///< counted from the border, as all cells here
  double most = 0.0;  ///< cost of the best path to the goal so far
  std::uint64_t generated = 0;
  const GridMap* ground = nullptr;
  Trace* trace = nullptr;

  [[nodiscard]] std::uint32_t state(Cell c) const { return ground->index({c.x - 1, c.y - 1}); }

  void begin(const GridQuery& query, Trace* told);

  /// Removes the first node that is not closed yet; returns false if there is none.
  bool pop(QueueEntry& first) {
    while (queue.pop(first)) {
      if (!nodes[first.node()].closed) return true;
    }
    return false;
  }

  /// Reaches c from a node, arriving in that direction.
  void reach(std::uint32_t from, Cell c, unsigned direction, unsigned sides) {
    ++generated;
    const std::uint32_t id = nodes.find_or_add(c);
    JumpNode& node = nodes[id];
    if (node.closed) return;
    const Octile g = nodes[from].g + octile_distance(nodes[from].cell, c);
    const double length = g.value();
    if (node.parent != JumpNode::none && !(length < node.length)) return;
    const double f = (g + octile_distance(c, goal)).value();
    if (!(f < most)) return;
    if (trace != nullptr && node.parent == JumpNode::none) trace->open(state(c));
    node = {c,    from, g, length, static_cast<std::uint8_t>(direction), static_cast<std::uint8_t>(sides),
            false};
    if (c == goal) most = f;
    queue.push(entry(f, length, id));
  }
};

/// Returns the plan that ends at a node.
Plan plan_to(std::uint32_t last, const Frontier& frontier, const Problem& problem, std::uint64_t expansions);

/// Runs the search; `expand(node)` reaches the next jump points.
template <class Expand>
Outcome<Plan> search(const Problem& problem, const GridQuery& query, Frontier& frontier, const Budget& budget,
                     Trace* trace, Expand expand) {
  BudgetMeter meter(budget);
  frontier.begin(query, trace);
  QueueEntry first;
  while (frontier.pop(first)) {
    if (!meter.spend()) return meter.refusal();
    const std::uint32_t id = first.node();
    JumpNode& node = frontier.nodes[id];
    node.closed = true;
    if (trace != nullptr) {
      trace->record({frontier.state(node.cell), frontier.state(frontier.nodes[node.parent].cell), first.f(),
                     node.g.value(), octile_distance(node.cell, frontier.goal).value()});
    }
    if (node.cell == frontier.goal) return plan_to(id, frontier, problem, meter.spent());
    expand(id);
  }
  return fault(FaultCode::no_path, "nothing joins the start and the goal");
}

}  // namespace outrider::jump
