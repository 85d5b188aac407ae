#include "octile_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "cell_at.hpp"
#include "octile.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/compact_labels.hpp"

namespace outrider {
namespace {

/// A search along the moves of the grid, led by the octile distance.
template <class CostType>
struct OctileMoves {
  using Cost = CostType;

  const GridQuery& query;
  double weight;
  const CompactLabels<Cost>& labels;
  const GridMap& ground = query.ground;
  CellAt cell_at{ground};
  State first = ground.index(query.start);
  State last = ground.index(query.goal);
  std::uint64_t generated = 0;

  [[nodiscard]] std::size_t states() const { return ground.marks.size(); }
  [[nodiscard]] State start() const { return first; }
  [[nodiscard]] bool is_goal(State s) const { return s == last; }
  [[nodiscard]] Cost estimate(State s) const { return octile_distance(cell_at(s), query.goal); }
  [[nodiscard]] static double value(Cost cost) { return cost.value(); }
  [[nodiscard]] double priority(Cost g, Cost h) const {
    return weight == 1.0 ? (g + h).value() : g.value() + weight * h.value();  // exact for 0 and 1
  }
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    expand(s, relax, [this](Cell v) { return octile_distance(v, query.goal); });
  }

  template <class Relax, class Estimate>
  void expand(State s, Relax& relax, const Estimate& estimate_of) {
    if ((ground.marks[s] & GridMap::pinch_bit) != 0 && s != first) return;
    const Cell v = cell_at(s);
    const Cost g = labels.g(s);
    for (unsigned left = ground.moves[s]; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const Cell next{v.x + grid_moves[i].x, v.y + grid_moves[i].y};
      const State neighbour = ground.index(next);
      ++generated;
      if (labels.closed(neighbour)) continue;
      relax(neighbour, s, g + Cost(i < 4 ? Octile{1, 0} : Octile{0, 1}), [&] { return estimate_of(next); });
    }
  }
};

using OctilePolicy = OctileMoves<Octile>;

/// A length along moves, or an estimate that is none.
struct Guided {
  Octile moves;
  double rest = 0.0;

  Guided() = default;
  explicit Guided(Octile length, double more = 0.0) : moves(length), rest(more) {}
  [[nodiscard]] double value() const { return moves.value() + rest; }
  friend Guided operator+(const Guided& a, const Guided& b) {
    return Guided(a.moves + b.moves, a.rest + b.rest);
  }
  friend bool operator<(const Guided& a, const Guided& b) { return a.value() < b.value(); }
};

struct GuidedPolicy : OctileMoves<Guided> {
  Guide guide;

  [[nodiscard]] Guided estimate_of(Cell v) const {
    const int dx = std::abs(v.x - query.goal.x), dy = std::abs(v.y - query.goal.y);
    switch (guide.heuristic) {
      case Heuristic::euclidean: return Guided({}, std::hypot(dx, dy));
      case Heuristic::chebyshev: return Guided({std::max(dx, dy), 0});
      case Heuristic::octile: break;
    }
    return Guided(octile_distance(v, query.goal));
  }
  [[nodiscard]] Guided estimate(State s) const { return estimate_of(cell_at(s)); }
  [[nodiscard]] double tie(const Guided& g) const { return guide.smallest_g ? -g.value() : g.value(); }

  template <class Relax>
  void expand(State s, Relax& relax) {
    OctileMoves::expand(s, relax, [this](Cell v) { return estimate_of(v); });
  }
};

/// A set of states: a hash table with open addressing, at most half full.
class StateSet {
 public:
  explicit StateSet(std::size_t most) : slots_(std::bit_ceil(2 * most + 2), none) {}
  /// Returns false if it was there.
  bool insert(State s) {
    State& slot = slots_[slot_of(s)];
    return std::exchange(slot, s) == none;
  }
  [[nodiscard]] bool contains(State s) const { return slots_[slot_of(s)] == s; }

 private:
  static constexpr State none = std::numeric_limits<State>::max();

  /// Returns the slot of a state, or that in which it would be.
  [[nodiscard]] std::size_t slot_of(State s) const {
    std::size_t slot = (std::size_t{s} * 0x9E3779B97F4A7C15U >> 32U) & (slots_.size() - 1);
    while (slots_[slot] != none && slots_[slot] != s) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  std::vector<State> slots_;
};

/// Searches without a heuristic until all wanted states are closed.
struct ManyGoalsPolicy : OctilePolicy {
  const StateSet& wanted;
  std::size_t waiting;

  [[nodiscard]] static Octile estimate(State /*s*/) { return {}; }
  [[nodiscard]] bool is_goal(State s) { return wanted.contains(s) && --waiting == 0; }
};

template <class Cost>
std::vector<Cell> vertices_to(State last, const GridMap& ground, const CompactLabels<Cost>& labels) {
  std::vector<Cell> vertices;
  for (const State s : path_to(last, labels)) vertices.push_back(ground.at(s));
  return vertices;
}

/// Returns the length along vertices that are one move apart.
Octile length_along(const std::vector<Cell>& vertices) {
  Octile length;
  for (std::size_t i = 1; i < vertices.size(); ++i)
    length = length + octile_distance(vertices[i - 1], vertices[i]);
  return length;
}

template <class Policy>
Outcome<Plan> search_by(Policy& policy, CompactMemory<typename Policy::Cost>& memory, const Problem& problem,
                        const GridQuery& query, double weight, const Budget& budget, Workspace& workspace) {
  BudgetMeter meter(budget);
  auto found = best_first(policy, memory, meter, workspace.trace);
  if (!found) return pass_on(found);
  const double resolution = query.ground.frame.resolution_m;
  const double cost = resolution * memory.labels.g(*found).value();
  const double straight = resolution * octile_distance(query.start, query.goal).value();
  const double bound = weight <= 1.0 ? cost : std::max(cost / weight, straight);
  return plan_along(problem, vertices_to(*found, query.ground, memory.labels), cost, bound,
                    {meter.spent(), policy.generated, 0});
}

}  // namespace

Outcome<Plan> octile_search(const Problem& problem, double weight, const Budget& budget,
                            Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  auto& memory = workspace.get<CompactMemory<Octile>>();
  OctilePolicy policy{*query, weight, memory.labels};
  return search_by(policy, memory, problem, *query, weight, budget, workspace);
}

Outcome<Plan> guided_search(const Problem& problem, const Guide& guide, const Budget& budget,
                            Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  auto& memory = workspace.get<CompactMemory<Guided>>();
  GuidedPolicy policy{{*query, guide.weight, memory.labels}, guide};
  return search_by(policy, memory, problem, *query, guide.weight, budget, workspace);
}

std::vector<Outcome<Plan>> octile_search_many(const Problem& problem, const std::vector<Vec2>& goals,
                                              const Budget& budget, Workspace& workspace) {
  std::vector<Outcome<GridQuery>> queries;
  StateSet wanted(goals.size());
  std::size_t waiting = 0, asked = goals.size();
  for (std::size_t i = 0; i < goals.size(); ++i) {
    queries.push_back(grid_query({problem.grid, problem.start, goals[i]}));
    if (!queries[i]) continue;
    asked = i;
    waiting += wanted.insert(queries[i]->ground.index(queries[i]->goal)) ? 1 : 0;
  }
  std::vector<Outcome<Plan>> plans;
  if (asked == goals.size()) {
    for (auto& query : queries) plans.emplace_back(pass_on(query));
    return plans;
  }
  auto& memory = workspace.get<CompactMemory<Octile>>();
  ManyGoalsPolicy policy{{*queries[asked], 0.0, memory.labels}, wanted, waiting};
  BudgetMeter meter(budget);
  const auto found = best_first(policy, memory, meter, workspace.trace);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    if (!queries[i]) {
      plans.emplace_back(pass_on(queries[i]));
      continue;
    }
    const GridMap& ground = queries[i]->ground;
    const State goal = ground.index(queries[i]->goal);
    if (!memory.labels.closed(goal)) {
      plans.emplace_back(pass_on(found));
      continue;
    }
    const auto vertices = vertices_to(goal, ground, memory.labels);
    const double cost = ground.frame.resolution_m * length_along(vertices).value();
    plans.emplace_back(plan_along({problem.grid, problem.start, goals[i]}, vertices, cost, cost,
                                  {meter.spent(), policy.generated, 0}));
  }
  return plans;
}

}  // namespace outrider
