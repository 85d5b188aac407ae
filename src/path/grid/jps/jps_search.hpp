// The common part of jump point search with and without an index: the reached jump points and their queue.
//
// Between a jump point and its parent the path runs along one diagonal and then straight, so its length is
// the octile distance of the two. Jump points in dead ends are dropped.
#pragma once

#include <cstdint>
#include <limits>

#include "grid/dead_ends/area_route.hpp"
#include "grid/dead_ends/known_dead_ends.hpp"
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
  Cell start;  ///< counted from the border, as all cells here
  Cell goal;   ///< counted from the border
  std::uint32_t goal_node = 0;
  double now = 0.0;   ///< f of the node that is expanded
  double most = 0.0;  ///< cost of the best path to the goal so far
  std::uint64_t generated = 0;
  const GridMap* ground = nullptr;
  const DeadEnds* ends = nullptr;  ///< null if they are not known
  AreaRoute route;
  Trace* trace = nullptr;

  [[nodiscard]] std::uint32_t state(Cell c) const { return ground->index({c.x - 1, c.y - 1}); }

  /// Returns false if nothing joins the start and the goal, as far as the dead ends tell.
  bool begin(const GridQuery& query, const DeadEnds* known, Trace* told);

  /// Removes the first node that is not closed yet; returns false if there is none.
  bool pop(QueueEntry& first) {
    while (queue.pop(first)) {
      if (!nodes[first.node()].closed) return true;
    }
    return false;
  }

  /// Sets a lower bound of the length from a cell to the goal; returns false if the cell is in a dead end.
  bool bound(Cell c, Octile& remaining) const {
    std::uint32_t label = DeadEnds::none;
    return bound(c, label, remaining);
  }
  /// The same, with the label of the cell in the dead ends, which is found if it is none.
  bool bound(Cell c, std::uint32_t& label, Octile& remaining) const {
    if (ends == nullptr) {
      remaining = octile_distance(c, goal);
      return true;
    }
    if (label == DeadEnds::none) label = ends->label(state(c));
    return route.bound(*ends, label, c, remaining);
  }

  /// Reaches the cell of a node from another node, arriving in that direction.
  void reach(std::uint32_t from, std::uint32_t id, unsigned direction) {
    ++generated;
    JumpNode& node = nodes[id];
    if (node.closed) return;
    const Cell c = node.cell;
    const Octile g = nodes[from].g + octile_distance(nodes[from].cell, c);
    const double length = g.value();
    const bool known = node.parent != JumpNode::none;
    if (known && !(length < node.length)) return;
    Octile remaining;
    if (!bound(c, node.label, remaining)) {
      node.closed = true;
      return;
    }
    const double f = (g + remaining).value();
    if (!(f < most)) return;
    if (trace != nullptr && !known) trace->open(state(c));
    node.parent = from;
    node.g = g;
    node.length = length;
    node.direction = static_cast<std::uint8_t>(direction);
    if (c == goal) most = f;
    queue.push(entry(f, length, id));
  }

  /// Returns true if a diagonal run of a node, which is scanned up to a cell and comes through another one,
  /// need not go on now: it cannot lead to a better path, or its rest waits in the queue.
  bool defer(std::uint32_t from, Cell scanned, Cell through, unsigned diagonal);
};

/// Returns the plan that ends at a node.
Plan plan_to(std::uint32_t last, const Frontier& frontier, const Problem& problem, std::uint64_t expansions);

/// Runs the search; `expand(node)` reaches the next jump points, or goes on with a run.
template <class Expand>
Outcome<Plan> search(const Problem& problem, const GridQuery& query, Frontier& frontier, KnownDeadEnds& ends,
                     const Budget& budget, Trace* trace, Expand expand) {
  BudgetMeter meter(budget);
  const auto no_path = [] { return fault(FaultCode::no_path, "nothing joins the start and the goal"); };
  if (!frontier.begin(query, ends.of(query.ground), trace)) return no_path();
  QueueEntry first;
  while (frontier.pop(first)) {
    const std::uint32_t id = first.node();
    JumpNode& node = frontier.nodes[id];
    node.closed = true;
    frontier.now = first.f();
    if (!node.is_rest_of_run()) {
      if (!meter.spend()) return meter.refusal();
      if (trace != nullptr) {
        trace->record({frontier.state(node.cell), frontier.state(frontier.nodes[node.parent].cell), first.f(),
                       node.g.value(), first.f() - node.g.value()});
      }
      if (node.cell == frontier.goal) {
        ends.spend(meter.spent());
        return plan_to(id, frontier, problem, meter.spent());
      }
    }
    expand(id);
  }
  ends.spend(meter.spent());
  return no_path();
}

}  // namespace outrider::jump
