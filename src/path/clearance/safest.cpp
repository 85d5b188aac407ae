#include "outrider/path/clearance/safest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "clearance_options.hpp"
#include "grid/octile.hpp"
#include "grid_clearance.hpp"
#include "outrider/path/clearance/medial_axis.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/search/best_first.hpp"
#include "straighten.hpp"

namespace outrider {
namespace {

/// Lattice indices of the start, the middle and the end of a move.
using Places = std::array<std::size_t, 3>;

/// The common part of both searches: states and moves, with the clearance at the ends and the middle of a
/// move.
struct MovesPolicy {
  using Cost = double;

  const GridQuery& query;
  const GridClearance& clearance;
  const Labels<double>& labels;
  const GridMap& ground = query.ground;
  std::uint64_t generated = 0;

  [[nodiscard]] std::size_t states() const { return ground.marks.size(); }
  [[nodiscard]] State start() const { return ground.index(query.start); }
  [[nodiscard]] bool is_goal(State s) const { return s == ground.index(query.goal); }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] static double priority(double g, double h) { return g + h; }
  static void settle(State /*s*/) {}

  /// Calls visit(v, vertex at the end of the move, its three places) for each legal move to a vertex that is
  /// not closed.
  template <class Visit>
  void for_each_move(State s, Visit visit) {
    const Cell v = ground.at(s);
    const std::size_t place = clearance.place(v);
    for (unsigned left = ground.moves[s]; left != 0; left &= left - 1) {
      const Cell move = grid_moves[static_cast<unsigned>(std::countr_zero(left))];
      const Cell next{v.x + move.x, v.y + move.y};
      ++generated;
      if (labels.closed(ground.index(next))) continue;
      const auto half = static_cast<std::size_t>(clearance.half(move));
      visit(v, next, {place, place + half, place + 2 * half});
    }
  }
  [[nodiscard]] std::uint32_t least_squared(const Places& places) const {
    return std::min(
        {clearance.squared[places[0]], clearance.squared[places[1]], clearance.squared[places[2]]});
  }
};

/// Minimises the loss, the amount by which the least clearance is below that of the widest place of the grid.
struct WidestMovesPolicy : MovesPolicy {
  [[nodiscard]] static double estimate(State /*s*/) { return 0.0; }

  [[nodiscard]] double loss(std::uint32_t squared) const {
    return std::sqrt(clearance.widest_squared) - std::sqrt(squared);
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const double g = labels.g(s);
    for_each_move(s, [&](Cell /*v*/, Cell next, const Places& places) {
      relax(ground.index(next), s, std::max(g, loss(least_squared(places))), 0.0);
    });
  }
};

/// Minimises length + weight * exposure, in cells, over the moves that are wide enough.
struct ExposureMovesPolicy : MovesPolicy {
  double weight = 0.0;          ///< cells
  double kept_squared = 0.0;    ///< half cells
  double least_per_cell = 1.0;  ///< no cell of length costs less

  [[nodiscard]] double estimate(Cell v) const {
    return least_per_cell * octile_distance(v, query.goal).value();
  }
  [[nodiscard]] double estimate(State s) const { return estimate(ground.at(s)); }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const double g = labels.g(s);
    for_each_move(s, [&](Cell v, Cell next, const Places& places) {
      if (least_squared(places) < kept_squared) return;
      const double exposed =
          part_exposure(clearance, {v.x + 0.5, v.y + 0.5}, {next.x + 0.5, next.y + 0.5},
                        clearance.at(places[0]), clearance.at(places[1]), clearance.at(places[2]));
      const double length = v.x != next.x && v.y != next.y ? std::numbers::sqrt2 : 1.0;
      relax(ground.index(next), s, g + length + weight * exposed, estimate(next));
    });
  }
};

/// The clearance of the ground of the last query.
struct ClearanceMemory {
  std::shared_ptr<const GridMap> made_for;
  GridClearance clearance;
};

/// Returns the clearance, which is meaningless after a stop request.
const GridClearance& clearance_of(const std::shared_ptr<const GridMap>& ground, const std::stop_token& stop,
                                  Workspace& workspace) {
  auto& memory = workspace.get<ClearanceMemory>();
  if (memory.made_for != ground) {
    memory.clearance = GridClearance::of(*ground, stop);
    memory.made_for = stop.stop_requested() ? nullptr : ground;
  }
  return memory.clearance;
}

Outcome<GridQuery> query_of(const Problem& problem) {
  auto query = grid_query(problem);
  if (!query) return query;
  const GridFrame& frame = query->ground.frame;
  if (query->ground.model != GridModel::cells) {
    return bad_input(fmt::format("on a grid of {} a path may run along a wall, at no clearance; take cells",
                                 to_string(query->ground.model)));
  }
  if (std::max(frame.width, frame.height) > GridClearance::most_side) {
    return bad_input(
        fmt::format("a grid of {} x {} cells is too large for clearances; expected {} a side at most",
                    frame.width, frame.height, GridClearance::most_side));
  }
  return query;
}

/// Returns the least squared clearance of the points on the path, in half cells.
std::uint32_t least_squared_of(const std::vector<State>& path, const GridMap& ground,
                               const GridClearance& clearance) {
  std::uint32_t least = clearance.squared[clearance.place(ground.at(path.front()))];
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Cell v = ground.at(path[i - 1]), next = ground.at(path[i]);
    const std::size_t middle = (clearance.place(v) + clearance.place(next)) / 2;
    least = std::min({least, clearance.squared[middle], clearance.squared[clearance.place(next)]});
  }
  return least;
}

/// Replaces runs of moves by straight legs in any direction that cost no more.
std::vector<State> straight_legs(const std::vector<State>& path, const ExposureMovesPolicy& policy,
                                 PlanCounters& counters) {
  const auto does = [&](std::size_t i, std::size_t j) {
    const Cell a = policy.ground.at(path[i]), b = policy.ground.at(path[j]);
    ++counters.line_of_sight_checks;
    if (!visible(policy.ground, a, b)) return false;
    if (!leg_is_wider(policy.clearance, a, b, 0.5 * std::sqrt(policy.kept_squared))) return false;
    const double leg =
        std::hypot(b.x - a.x, b.y - a.y) + policy.weight * leg_exposure(policy.clearance, a, b);
    return leg <= policy.labels.g(path[j]) - policy.labels.g(path[i]);
  };
  std::vector<State> kept;
  for (const std::size_t i : straightened(path.size(), does)) kept.push_back(path[i]);
  return kept;
}

/// Returns the plan along those vertices, with its cost.
Plan plan_of(const Problem& problem, const std::vector<Cell>& vertices, const GridClearance& clearance,
             double weight_m, double least_along_moves, const PlanCounters& counters) {
  Plan plan = plan_along(problem, vertices, 0.0, 0.0, counters);
  for (std::size_t i = 1; i < plan.vertices.size(); ++i) {
    plan.exposure += leg_exposure(clearance, plan.vertices[i - 1], plan.vertices[i]);
  }
  plan.weights.per_exposure_m = weight_m;
  plan.cost = length_of(plan) + weight_m * plan.exposure;
  plan.lower_bound = std::min(plan.cost, least_along_moves);
  return plan;
}

}  // namespace

std::vector<Option> describe(SafestOptions& options) {
  return {
      weight_option(options.weight_m),
      kept_option(options.kept),
      {"along_moves", "", 0.0, 0.0,
       "leaves the path along the moves, without few straight legs in their place", &options.along_moves}};
}

Outcome<Plan> safest(const Problem& problem, const SafestOptions& options, const Budget& budget,
                     Workspace& workspace) {
  if (auto good = check_weight(options.weight_m); !good) return pass_on(good);
  if (auto good = check_share(options.kept, "kept"); !good) return pass_on(good);
  if (problem.polygons) {
    return medial_axis(problem, {.weight_m = options.weight_m, .kept = options.kept}, budget, workspace);
  }
  auto query = query_of(problem);
  if (!query) return pass_on(query);
  const GridMap& ground = query->ground;
  const GridClearance& clearance = clearance_of(problem.grid, budget.stop, workspace);
  auto& memory = workspace.get<SearchMemory<double>>();
  BudgetMeter meter(budget);

  WidestMovesPolicy widest{{*query, clearance, memory.labels}};
  auto found = best_first(widest, memory, meter, workspace.trace);
  if (!found) return pass_on(found);
  const double largest = least_squared_of(path_to(*found, memory.labels), ground, clearance);

  ExposureMovesPolicy briefest{{*query, clearance, memory.labels}};
  briefest.weight = options.weight_m / ground.frame.resolution_m;
  briefest.kept_squared = options.kept * options.kept * largest;
  briefest.least_per_cell = 1.0 + briefest.weight * 2.0 / std::sqrt(clearance.widest_squared);
  found = best_first(briefest, memory, meter, workspace.trace);
  if (!found) return pass_on(found);

  PlanCounters counters{meter.spent(), widest.generated + briefest.generated, 0};
  std::vector<State> path = path_to(*found, memory.labels);
  if (!options.along_moves) path = straight_legs(path, briefest, counters);
  std::vector<Cell> vertices;
  for (const State s : path) vertices.push_back(ground.at(s));
  return plan_of(problem, vertices, clearance, options.weight_m,
                 ground.frame.resolution_m * memory.labels.g(*found), counters);
}

}  // namespace outrider
