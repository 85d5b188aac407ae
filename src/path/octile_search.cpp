#include "octile_search.hpp"

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
  const GridGround& ground = query.ground;
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
    if ((ground.marks[s] & GridGround::pinch_bit) != 0 && s != first) return;
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

  std::vector<Cell> vertices;
  for (const State s : path_to(*found, memory.labels)) vertices.push_back(query->ground.at(s));
  const double resolution = query->ground.frame.resolution_m;
  const double cost = resolution * memory.labels.g(*found).value();
  const double straight = resolution * octile_distance(query->start, query->goal).value();
  const double bound = weight <= 1.0 ? cost : std::max(cost / weight, straight);
  return plan_along(problem, vertices, cost, bound, {meter.spent(), policy.generated, 0});
}

}  // namespace outrider
