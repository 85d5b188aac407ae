#include "jps_search.hpp"

#include <algorithm>

namespace outrider::jump {

bool Frontier::begin(const GridQuery& query, const DeadEnds* known, Trace* told) {
  start = {query.start.x + 1, query.start.y + 1};
  goal = {query.goal.x + 1, query.goal.y + 1};
  most = std::numeric_limits<double>::infinity();
  generated = 0;
  ground = &query.ground;
  ends = known;
  trace = told;
  nodes.clear();
  queue.clear();
  if (ends != nullptr && !route.begin(*ends, state(start), state(goal), goal)) return false;
  Octile remaining;
  bound(start, remaining);
  nodes[nodes.find_or_add(start)].parent = 0;
  goal_node = nodes.find_or_add(goal);
  queue.push(entry(remaining.value(), 0.0, 0));
  if (trace != nullptr) trace->open(state(start));
  return true;
}

bool Frontier::defer(std::uint32_t from, Cell scanned, Cell through, unsigned diagonal) {
  Octile remaining;
  if (!bound(through, remaining)) return true;
  const Octile g = nodes[from].g + octile_distance(nodes[from].cell, through);
  const double f = (g + remaining).value();
  if (!(f < most)) return true;
  if (!(f > now)) return false;
  JumpNode rest{scanned, from, g};
  rest.direction = static_cast<std::uint8_t>(diagonal);
  queue.push(entry(f, g.value(), nodes.add(rest)));
  return true;
}

Plan plan_to(std::uint32_t last, const Frontier& frontier, const Problem& problem, std::uint64_t expansions) {
  std::vector<Cell> cells;
  const auto add = [&](Cell c) { cells.push_back({c.x - 1, c.y - 1}); };
  for (std::uint32_t id = last;; id = frontier.nodes[id].parent) {
    const Cell to = frontier.nodes[id].cell;
    add(to);
    const std::uint32_t parent = frontier.nodes[id].parent;
    if (parent == id) break;
    const Cell from = frontier.nodes[parent].cell;
    const Octile way = octile_distance(from, to);
    if (way.straight == 0 || way.diagonal == 0) continue;
    add({from.x + (to.x > from.x ? way.diagonal : -way.diagonal),
         from.y + (to.y > from.y ? way.diagonal : -way.diagonal)});
  }
  std::reverse(cells.begin(), cells.end());
  const double cost = problem.grid->frame.resolution_m * frontier.nodes[last].g.value();
  return plan_along(problem, cells, cost, cost, {expansions, frontier.generated, 0});
}

}  // namespace outrider::jump
