#include "outrider/path/grid/theta_star.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/search/best_first.hpp"

namespace outrider {
namespace {

double straight_distance(Cell a, Cell b) {
  const auto dx = static_cast<double>(a.x - b.x), dy = static_cast<double>(a.y - b.y);
  return std::sqrt(dx * dx + dy * dy);  // the sum is exact
}

/// The common part of both forms; costs are in cells.
struct FreeDirectionPolicy {
  using Cost = double;

  const GridQuery& query;
  Labels<double>& labels;
  const GridMap& ground = query.ground;
  State first = ground.index(query.start);
  State last = ground.index(query.goal);
  PlanCounters counters{};

  [[nodiscard]] std::size_t states() const { return ground.marks.size(); }
  [[nodiscard]] State start() const { return first; }
  [[nodiscard]] bool is_goal(State s) const { return s == last; }
  [[nodiscard]] double estimate(State s) const { return straight_distance(ground.at(s), query.goal); }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] static double priority(double g, double h) { return g + h; }

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
    const Cell v = ground.at(s);
    for (unsigned left = ground.moves[s]; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const Cell next{v.x + grid_moves[i].x, v.y + grid_moves[i].y};
      visit(ground.index(next), next, i < 4 ? 1.0 : std::numbers::sqrt2);
    }
  }
};

struct ThetaPolicy : FreeDirectionPolicy {
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (!passable(s)) return;
    const State parent = labels.parent(s);
    const Cell from = ground.at(parent);
    const double g = labels.g(s), parent_g = labels.g(parent);
    for_each_move(s, [&](State neighbour, Cell next, double move) {
      ++counters.generated;
      if (labels.closed(neighbour)) return;
      const double direct = parent_g + straight_distance(from, next);
      if (labels.known(neighbour) && !(direct < labels.g(neighbour))) return;  // nor is the way through s
      const bool seen = sees(from, next);
      relax(neighbour, seen ? parent : s, seen ? direct : g + move, straight_distance(next, query.goal));
    });
  }
};

struct LazyThetaPolicy : FreeDirectionPolicy {
  /// Keeps the parent if it is visible; otherwise takes the closed neighbour with the shortest path to s.
  void settle(State s) {
    const State parent = labels.parent(s);
    if (parent == s || sees(ground.at(parent), ground.at(s))) return;
    State best = parent;
    double least = std::numeric_limits<double>::infinity();
    for_each_move(s, [&](State neighbour, Cell /*next*/, double move) {
      if (!labels.closed(neighbour) || !passable(neighbour)) return;
      const double g = labels.g(neighbour) + move;
      if (g < least || (g == least && neighbour < best)) {
        least = g;
        best = neighbour;
      }
    });
    labels.open(s, best, least);
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (!passable(s)) return;
    const State parent = labels.parent(s);
    const Cell from = ground.at(parent);
    const double parent_g = labels.g(parent);
    for_each_move(s, [&](State neighbour, Cell next, double /*move*/) {
      ++counters.generated;
      if (labels.closed(neighbour)) return;
      relax(neighbour, parent, parent_g + straight_distance(from, next), straight_distance(next, query.goal));
    });
  }
};

template <class Policy>
Outcome<Plan> free_direction_search(const Problem& problem, const Budget& budget, Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  auto& memory = workspace.get<SearchMemory<double>>();
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
