#include "octile_search.hpp"

#include <algorithm>
#include <bit>

#include "octile.hpp"
#include "outrider/search/best_first.hpp"

namespace outrider {
namespace {

struct OctilePolicy {
  using Cost = Octile;

  const GridQuery& query;
  double weight;
  const Labels<Octile>& labels;
  const GridMap& ground = query.ground;
  State first = ground.index(query.start);
  State last = ground.index(query.goal);
  std::uint64_t generated = 0;

  [[nodiscard]] std::size_t states() const { return ground.marks.size(); }
  [[nodiscard]] State start() const { return first; }
  [[nodiscard]] bool is_goal(State s) const { return s == last; }
  [[nodiscard]] Octile estimate(Cell v) const { return octile_distance(v, query.goal); }
  [[nodiscard]] Octile estimate(State s) const { return estimate(ground.at(s)); }
  [[nodiscard]] static double value(Octile cost) { return cost.value(); }
  [[nodiscard]] double priority(Octile g, Octile h) const {
    return weight == 1.0 ? (g + h).value() : g.value() + weight * h.value();  // exact for 0 and 1
  }
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    if ((ground.marks[s] & GridMap::pinch_bit) != 0 && s != first) return;
    const Cell v = ground.at(s);
    const Octile g = labels.g(s);
    for (unsigned left = ground.moves[s]; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const Cell next{v.x + grid_moves[i].x, v.y + grid_moves[i].y};
      const State neighbour = ground.index(next);
      ++generated;
      if (labels.closed(neighbour)) continue;
      relax(neighbour, s, g + (i < 4 ? Octile{1, 0} : Octile{0, 1}), estimate(next));
    }
  }
};

/// Searches without a heuristic until all wanted states are closed.
struct ManyGoalsPolicy : OctilePolicy {
  std::vector<std::uint8_t>& wanted;  // by state
  std::size_t waiting;

  [[nodiscard]] static Octile estimate(State /*s*/) { return {}; }
  [[nodiscard]] bool is_goal(State s) { return wanted[s] != 0 && --waiting == 0; }
};

/// Memory kept between queries; all values are 0.
struct WantedMemory {
  std::vector<std::uint8_t> of_state;
};

std::vector<Cell> vertices_to(State last, const GridMap& ground, const Labels<Octile>& labels) {
  std::vector<Cell> vertices;
  for (const State s : path_to(last, labels)) vertices.push_back(ground.at(s));
  return vertices;
}

}  // namespace

Outcome<Plan> octile_search(const Problem& problem, double weight, const Budget& budget,
                            Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  auto& memory = workspace.get<SearchMemory<Octile>>();
  OctilePolicy policy{*query, weight, memory.labels};
  BudgetMeter meter(budget);
  auto found = best_first(policy, memory, meter, workspace.trace);
  if (!found) return pass_on(found);

  const double resolution = query->ground.frame.resolution_m;
  const double cost = resolution * memory.labels.g(*found).value();
  const double straight = resolution * octile_distance(query->start, query->goal).value();
  const double bound = weight <= 1.0 ? cost : std::max(cost / weight, straight);
  return plan_along(problem, vertices_to(*found, query->ground, memory.labels), cost, bound,
                    {meter.spent(), policy.generated, 0});
}

std::vector<Outcome<Plan>> octile_search_many(const Problem& problem, const std::vector<Vec2>& goals,
                                              const Budget& budget, Workspace& workspace) {
  std::vector<Outcome<GridQuery>> queries;
  auto& wanted = workspace.get<WantedMemory>().of_state;
  std::size_t waiting = 0, asked = goals.size();
  for (std::size_t i = 0; i < goals.size(); ++i) {
    queries.push_back(grid_query({problem.grid, problem.start, goals[i]}));
    if (!queries[i]) continue;
    asked = i;
    wanted.resize(std::max(wanted.size(), queries[i]->ground.marks.size()));
    std::uint8_t& mark = wanted[queries[i]->ground.index(queries[i]->goal)];
    waiting += mark == 0 ? 1 : 0;
    mark = 1;
  }
  std::vector<Outcome<Plan>> plans;
  if (asked == goals.size()) {
    for (auto& query : queries) plans.emplace_back(pass_on(query));
    return plans;
  }
  auto& memory = workspace.get<SearchMemory<Octile>>();
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
    wanted[goal] = 0;
    if (!memory.labels.closed(goal)) {
      plans.emplace_back(tl::unexpected(found.error()));
      continue;
    }
    const double cost = ground.frame.resolution_m * memory.labels.g(goal).value();
    plans.emplace_back(plan_along({problem.grid, problem.start, goals[i]},
                                  vertices_to(goal, ground, memory.labels), cost, cost,
                                  {meter.spent(), policy.generated, 0}));
  }
  return plans;
}

}  // namespace outrider
