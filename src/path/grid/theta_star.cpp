#include "outrider/path/grid/theta_star.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "cell_at.hpp"
#include "grid/terrain/cost_over_parent.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/compact_labels.hpp"

namespace outrider {
namespace {

double straight_distance(Cell a, Cell b) {
  const auto dx = static_cast<double>(a.x - b.x), dy = static_cast<double>(a.y - b.y);
  return std::sqrt(dx * dx + dy * dy);  // the sum is exact
}

/// The common part of both forms; costs are in cells.
template <ClosedCosts closed_costs>
struct FreeDirectionPolicy {
  using Cost = CostOverParent;
  using Memory = CompactMemory<CostOverParent, closed_costs>;

  const GridQuery& query;
  CompactLabels<CostOverParent, closed_costs>& labels;
  const GridMap& ground = query.ground;
  CellAt cell_at{ground};
  State first = ground.index(query.start);
  State last = ground.index(query.goal);
  PlanCounters counters{};

  [[nodiscard]] std::size_t states() const { return ground.marks.size(); }
  [[nodiscard]] State start() const { return first; }
  [[nodiscard]] bool is_goal(State s) const { return s == last; }
  [[nodiscard]] CostOverParent estimate(Cell v) const { return {straight_distance(v, query.goal)}; }
  [[nodiscard]] CostOverParent estimate(State s) const { return estimate(cell_at(s)); }
  [[nodiscard]] static double value(const CostOverParent& cost) { return cost.g; }
  [[nodiscard]] static double priority(const CostOverParent& cost, const CostOverParent& h) {
    return cost.g + h.g;
  }

  bool sees(Cell a, Cell b) {
    ++counters.line_of_sight_checks;
    return visible(ground, a, b);
  }
  /// Returns true if a path may continue from s: everywhere except at a pinch other than the start.
  [[nodiscard]] bool passable(State s) const {
    return (ground.marks[s] & GridMap::pinch_bit) == 0 || s == first;
  }
  /// Calls visit(neighbour's state, its vertex, length of the move) for every legal move from s.
  template <class Visit>
  void for_each_move(State s, Visit visit) {
    const Cell v = cell_at(s);
    for (unsigned left = ground.moves[s]; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const Cell next{v.x + grid_moves[i].x, v.y + grid_moves[i].y};
      visit(ground.index(next), next, i < 4 ? 1.0 : std::numbers::sqrt2);
    }
  }
};

struct ThetaPolicy : FreeDirectionPolicy<ClosedCosts::dropped> {
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (!passable(s)) return;
    const State parent = labels.parent(s);
    const Cell from = cell_at(parent);
    const double g = labels.g(s).g, parent_g = labels.g(s).parent_g;
    for_each_move(s, [&](State neighbour, Cell next, double move) {
      ++counters.generated;
      if (labels.closed(neighbour)) return;
      const double direct = parent_g + straight_distance(from, next);
      if (labels.known(neighbour) && !(direct < labels.g(neighbour).g)) return;  // nor is the way through s
      if (sees(from, next)) {
        relax(neighbour, parent, CostOverParent{direct, parent_g}, [&] { return estimate(next); });
      } else {
        relax(neighbour, s, CostOverParent{g + move, g}, [&] { return estimate(next); });
      }
    });
  }
};

/// The costs of closed vertices are kept while they have neighbours that are not closed, for settle().
struct LazyThetaPolicy : FreeDirectionPolicy<ClosedCosts::kept> {
  /// Keeps the parent if it is visible; otherwise takes the closed neighbour with the shortest path to s.
  void settle(State s) {
    const State parent = labels.parent(s);
    if (parent == s || sees(cell_at(parent), cell_at(s))) return;
    State best = parent;
    CostOverParent least{std::numeric_limits<double>::infinity()};
    for_each_move(s, [&](State neighbour, Cell /*next*/, double move) {
      if (!labels.closed(neighbour) || !passable(neighbour)) return;
      const double parent_g = labels.g(neighbour).g, g = parent_g + move;
      if (g < least.g || (g == least.g && neighbour < best)) {
        least = {g, parent_g};
        best = neighbour;
      }
    });
    labels.open(s, best, least);
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const bool through = passable(s);
    const State parent = labels.parent(s);
    const Cell from = cell_at(parent);
    const double parent_g = labels.g(s).parent_g;
    unsigned not_closed = 0;
    for_each_move(s, [&](State neighbour, Cell next, double /*move*/) {
      counters.generated += through ? 1 : 0;
      if (labels.closed(neighbour)) {
        labels.count_down(neighbour);
        return;
      }
      ++not_closed;
      if (!through) return;
      const CostOverParent cost{parent_g + straight_distance(from, next), parent_g};
      relax(neighbour, parent, cost, [&] { return estimate(next); });
    });
    labels.keep_until(s, through ? not_closed : 0);
  }
};

template <class Policy>
Outcome<Plan> free_direction_search(const Problem& problem, const Budget& budget, Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  auto& memory = workspace.get<typename Policy::Memory>();
  Policy policy{{*query, memory.labels}};
  BudgetMeter meter(budget);
  auto found = best_first(policy, memory, meter, workspace.trace);
  if (!found) return pass_on(found);

  std::vector<Cell> vertices;
  for (const State s : path_to(*found, memory.labels)) vertices.push_back(query->ground.at(s));
  double cost = 0.0;
  for (std::size_t i = 1; i < vertices.size(); ++i) cost += straight_distance(vertices[i - 1], vertices[i]);
  const double resolution = query->ground.frame.resolution_m;
  policy.counters.expansions = meter.spent();
  return plan_along(problem, vertices, resolution * cost,
                    resolution * straight_distance(query->start, query->goal), policy.counters);
}

}  // namespace

std::vector<Option> describe(ThetaStarOptions& /*options*/) { return {}; }
std::vector<Option> describe(LazyThetaStarOptions& /*options*/) { return {}; }

Outcome<Plan> theta_star(const Problem& problem, const ThetaStarOptions& /*options*/, const Budget& budget,
                         Workspace& workspace) {
  return free_direction_search<ThetaPolicy>(problem, budget, workspace);
}

Outcome<Plan> lazy_theta_star(const Problem& problem, const LazyThetaStarOptions& /*options*/,
                              const Budget& budget, Workspace& workspace) {
  return free_direction_search<LazyThetaPolicy>(problem, budget, workspace);
}

}  // namespace outrider
