#include "outrider/path/grid/jps/jps_plus.hpp"

#include <fmt/format.h>

#include "grid/grid_follow.hpp"
#include "jps_index.hpp"
#include "jps_search.hpp"

namespace outrider {
namespace jump {
namespace {

struct IndexedMemory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the distances
  std::vector<Distances> distances;
  KnownDeadEnds ends{true};
  Frontier frontier;
};

class IndexedExpansion {
 public:
  IndexedExpansion(const GridMap& ground, const std::vector<Distances>& distances, Frontier& frontier)
      : ground_(ground), distances_(distances), frontier_(frontier) {}

  void operator()(std::uint32_t id) {
    const JumpNode node = frontier_.nodes[id];
    id_ = id;
    from_ = node.cell;
    at_ = static_cast<std::size_t>(from_.y) * ground_.stride + static_cast<std::size_t>(from_.x);
    if (node.parent == id) {
      for (const unsigned d : {east, north, west, south}) run(d);
      for (const unsigned h : {east, west}) {
        for (const unsigned v : {north, south}) run_diagonally(h, v);
      }
      return;
    }
    run(node.direction);
    const unsigned sides = forced_sides(ground_.moves[at_], node.direction);
    for (const unsigned side : {lower, higher}) {
      if ((sides & side) == 0) continue;
      const unsigned turn = side_of(node.direction, side);
      run(turn);
      horizontal(turn) ? run_diagonally(turn, node.direction) : run_diagonally(node.direction, turn);
    }
  }

 private:
  /// Reaches the goal if it lies on the straight run from the cell, otherwise the cell at which the run stops
  /// at a turn.
  void run(unsigned d) {
    const int length = distances_[at_][d];
    if (!run_to_goal(from_, d, length) && length > 0) reach(from_, d, length);
  }

  bool run_to_goal(Cell c, unsigned d, int length) {
    const Cell along = grid_moves[d], to{frontier_.goal.x - c.x, frontier_.goal.y - c.y};
    const int ahead = to.x * along.x + to.y * along.y;
    const bool on_line = (horizontal(d) ? to.y : to.x) == 0;
    if (!on_line || ahead <= 0 || ahead > std::abs(length)) return false;
    reach(frontier_.goal, d);
    return true;
  }

  void reach(Cell c, unsigned d, int length) {
    reach({c.x + grid_moves[d].x * length, c.y + grid_moves[d].y * length}, d);
  }
  void reach(Cell c, unsigned d) { frontier_.reach(id_, frontier_.nodes.find_or_add(c), d); }

  void run_diagonally(unsigned h, unsigned v) {
    const unsigned diagonal = diagonal_of(h, v);
    const Cell d = grid_moves[diagonal];
    const std::ptrdiff_t step = d.y * static_cast<std::ptrdiff_t>(ground_.stride) + d.x;
    const int to_column = d.x * (frontier_.goal.x - from_.x), to_row = d.y * (frontier_.goal.y - from_.y);
    const int to_line = std::min(to_column, to_row);  // the step that is in line with the goal
    const Distances* at = distances_.data() + at_;
    for (int steps = 0;;) {
      const int leap = (*at)[diagonal];
      if (to_line > steps && to_line <= steps + std::abs(leap)) {
        const Cell c{from_.x + to_line * d.x, from_.y + to_line * d.y};
        const unsigned turn = to_row == to_line ? h : v;
        if (c == frontier_.goal) reach(c, h);
        run_to_goal(c, turn, at[(to_line - steps) * step][turn]);
      }
      if (leap <= 0) return;
      steps += leap;
      at += leap * step;
      const Cell c{from_.x + steps * d.x, from_.y + steps * d.y};
      if ((*at)[h] > 0) reach(c, h, (*at)[h]);
      if ((*at)[v] > 0) reach(c, v, (*at)[v]);
    }
  }

  const GridMap& ground_;
  const std::vector<Distances>& distances_;
  Frontier& frontier_;
  std::uint32_t id_ = 0;
  Cell from_;
  std::size_t at_ = 0;  // index of from_
};

}  // namespace
}  // namespace jump

std::vector<Option> describe(JpsPlusOptions& /*options*/) { return {}; }

Outcome<Plan> jps_plus(const Problem& problem, const JpsPlusOptions& /*options*/, const Budget& budget,
                       Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  const GridMap& ground = query->ground;
  if (ground.model != GridModel::cells) {
    return bad_input("jps_plus takes grids of the model 'cells', not 'corners'; take a_star instead",
                     "planner");
  }
  if (std::max(ground.frame.width, ground.frame.height) > jump::longest_indexed_side) {
    return bad_input(fmt::format("jps_plus takes sides up to {} cells, not {} x {}; take jps instead",
                                 jump::longest_indexed_side, ground.frame.width, ground.frame.height),
                     "planner");
  }
  auto& memory = workspace.get<jump::IndexedMemory>();
  follow(
      memory.ground, problem.grid,
      [&] {
        memory.distances = jump::distances_of(ground, budget.stop);
        memory.ends.make(ground);
      },
      [&](const auto& changed) {
        jump::walk_again(memory.distances, ground, changed);
        if (!changed.empty()) memory.ends.change();
      });
  if (budget.stop.stop_requested()) {
    memory.ground = nullptr;
    return BudgetMeter(budget).refusal();
  }
  return jump::search(problem, *query, memory.frontier, memory.ends, budget, workspace.trace,
                      jump::IndexedExpansion(ground, memory.distances, memory.frontier));
}

}  // namespace outrider
