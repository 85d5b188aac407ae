#include "outrider/path/grid/terrain/terrain_a_star.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "cost_over_parent.hpp"
#include "grid/cell_at.hpp"
#include "grid/octile.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/compact_labels.hpp"
#include "terrain_query.hpp"
#include "terrain_refine.hpp"

namespace outrider {
namespace {

double straight_distance(Cell a, Cell b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The common part of both searches; lengths are in cells.
struct TerrainPolicy {
  using Cost = CostOverParent;

  const GridQuery& query;
  const CellCosts* costs;  // null: a metre costs 1
  const CompactLabels<Cost>& labels;
  const GridMap& ground = query.ground;
  CellAt cell_at{ground};
  State first = ground.index(query.start);
  State last = ground.index(query.goal);
  double least = costs == nullptr ? 1.0 : costs->least;
  std::uint64_t generated = 0;

  [[nodiscard]] std::size_t states() const { return ground.marks.size(); }
  [[nodiscard]] State start() const { return first; }
  [[nodiscard]] bool is_goal(State s) const { return s == last; }
  [[nodiscard]] static double value(const CostOverParent& cost) { return cost.g; }
  [[nodiscard]] static double priority(const CostOverParent& cost, const CostOverParent& h) {
    return cost.g + h.g;
  }
  static void settle(State /*s*/) {}

  /// Calls visit(neighbour's state, its vertex, cost of the move) for every legal move from s.
  template <class Visit>
  void for_each_move(State s, Visit visit) {
    const Cell v = cell_at(s);
    for (unsigned left = ground.moves[s]; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const Cell next{v.x + grid_moves[i].x, v.y + grid_moves[i].y};
      const double length = i < 4 ? 1.0 : std::numbers::sqrt2;
      const double mean =
          costs == nullptr ? 1.0 : 0.5 * (double{costs->per_m[v]} + double{costs->per_m[next]});
      ++generated;
      visit(ground.index(next), next, length * mean);
    }
  }
};

struct AlongMoves : TerrainPolicy {
  [[nodiscard]] CostOverParent estimate(Cell v) const {
    return {least * octile_distance(v, query.goal).value()};
  }
  [[nodiscard]] CostOverParent estimate(State s) const { return estimate(cell_at(s)); }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const double g = labels.g(s).g;
    for_each_move(s, [&](State neighbour, Cell next, double move) {
      if (!labels.closed(neighbour))
        relax(neighbour, s, CostOverParent{g + move, g}, [&] { return estimate(next); });
    });
  }
};

struct InAnyDirection : TerrainPolicy {
  [[nodiscard]] CostOverParent estimate(Cell v) const { return {least * straight_distance(v, query.goal)}; }
  [[nodiscard]] CostOverParent estimate(State s) const { return estimate(cell_at(s)); }

  std::uint64_t line_of_sight_checks = 0;

  bool sees(Cell a, Cell b) {
    ++line_of_sight_checks;
    return visible(ground, a, b);
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const State parent = labels.parent(s);
    const Cell from = cell_at(parent);
    const double g = labels.g(s).g, parent_g = labels.g(s).parent_g;
    for_each_move(s, [&](State neighbour, Cell next, double move) {
      if (labels.closed(neighbour)) return;
      const double through = g + move, none_less = parent_g + least * straight_distance(from, next);
      if (labels.known(neighbour) && !(std::min(through, none_less) < labels.g(neighbour).g)) return;
      const double direct = none_less <= through ? parent_g + leg_cost(costs, from, next) : through + 1.0;
      if (direct <= through && sees(from, next)) {
        relax(neighbour, parent, CostOverParent{direct, parent_g}, [&] { return estimate(next); });
      } else {
        relax(neighbour, s, CostOverParent{through, g}, [&] { return estimate(next); });
      }
    });
  }
};

/// Searches by a policy and returns its path.
template <class Policy>
Outcome<std::vector<Cell>> search_by(Policy& policy, CompactMemory<CostOverParent>& memory,
                                     BudgetMeter& meter, Trace* trace) {
  auto found = best_first(policy, memory, meter, trace);
  if (!found) return pass_on(found);
  std::vector<Cell> vertices;
  for (const State s : path_to(*found, memory.labels)) vertices.push_back(policy.ground.at(s));
  return vertices;
}

}  // namespace

std::vector<Option> describe(TerrainAStarOptions& /*options*/) { return {}; }
std::vector<Option> describe(TerrainThetaStarOptions& /*options*/) { return {}; }

Outcome<Plan> terrain_a_star(const Problem& problem, const TerrainAStarOptions& /*options*/,
                             const Budget& budget, Workspace& workspace) {
  auto query = terrain_query(problem, "terrain_a_star");
  if (!query) return pass_on(query);
  auto& memory = workspace.get<CompactMemory<CostOverParent>>();
  AlongMoves policy{{*query, problem.costs.get(), memory.labels}};
  BudgetMeter meter(budget);
  auto path = search_by(policy, memory, meter, workspace.trace);
  if (!path) return pass_on(path);
  return priced_plan(problem, *path, std::numeric_limits<double>::infinity(),
                     {meter.spent(), policy.generated, 0});
}

Outcome<Plan> terrain_theta_star(const Problem& problem, const TerrainThetaStarOptions& /*options*/,
                                 const Budget& budget, Workspace& workspace) {
  auto query = terrain_query(problem, "terrain_theta_star");
  if (!query) return pass_on(query);
  auto& memory = workspace.get<CompactMemory<CostOverParent>>();
  AlongMoves along{{*query, problem.costs.get(), memory.labels}};
  InAnyDirection any{{*query, problem.costs.get(), memory.labels}};
  BudgetMeter meter(budget);
  auto moves = search_by(along, memory, meter, workspace.trace);
  if (!moves) return pass_on(moves);
  auto legs = search_by(any, memory, meter, workspace.trace);
  if (!legs) return pass_on(legs);
  PlanCounters counters{meter.spent(), along.generated + any.generated, any.line_of_sight_checks};
  const CellCosts* costs = problem.costs.get();
  const auto by_moves = refined_path(query->ground, costs, std::move(*moves), counters);
  const auto by_legs = refined_path(query->ground, costs, std::move(*legs), counters);
  const bool moves_first = path_cost(costs, by_moves) < path_cost(costs, by_legs);
  return priced_plan(problem, moves_first ? by_moves : by_legs,
                     any.least * straight_distance(query->start, query->goal), counters);
}

}  // namespace outrider
