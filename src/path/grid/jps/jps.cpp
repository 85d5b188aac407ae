#include "outrider/path/grid/jps/jps.hpp"

#include <algorithm>

#include "grid/grid_follow.hpp"
#include "jps_index.hpp"
#include "jps_map.hpp"
#include "jps_scan.hpp"
#include "jps_search.hpp"
#include "jump_lists.hpp"

namespace outrider {
namespace jump {
namespace {

struct Memory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the map
  Map map;
  KnownDeadEnds ends;
  JumpLists lists;
  std::uint32_t query = 0;
  Frontier frontier;
};

class Expansion {
 public:
  explicit Expansion(Memory& memory) : map_(memory.map), memory_(memory), frontier_(memory.frontier) {}

  void operator()(std::uint32_t id) {
    const JumpNode node = frontier_.nodes[id];
    id_ = node.is_rest_of_run() ? node.parent : id;
    from_ = frontier_.nodes[id_].cell;
    if (node.is_rest_of_run()) {
      run_diagonally(node.cell, node.direction);
    } else if (node.parent == id) {
      leave_start();
    } else {
      follow_list(memory_.lists.next(map_, *frontier_.ground, node.point, node.direction), node.direction);
    }
  }

 private:
  static constexpr int block = 16;  // steps of a diagonal run before it may have to wait

  void leave_start() {
    auto emit = [this](Cell c, unsigned d) { reach(memory_.lists.number(c), d); };
    for (const unsigned d : {east, north, west, south}) {
      find_goal(from_, d, scan_straight(map_, from_, d, 0, emit));
    }
    const unsigned moves = frontier_.ground->moves[frontier_.state(from_)];
    for (unsigned diagonal = 4; diagonal < 8; ++diagonal) {
      if (((moves >> diagonal) & 1U) == 0) continue;
      const Cell step = grid_moves[diagonal];
      const Cell next{from_.x + step.x, from_.y + step.y};
      if (!frontier_.defer(id_, from_, next, diagonal)) run_diagonally(from_, diagonal);
    }
  }

  /// Scans along a diagonal run of the start from a cell on, until it may have to wait.
  void run_diagonally(Cell c, unsigned diagonal) {
    const Cell step = grid_moves[diagonal];
    const unsigned h = step.x > 0 ? east : west, v = step.y > 0 ? north : south;
    auto emit = [this](Cell found, unsigned d) { reach(memory_.lists.number(found), d); };
    for (;;) {
      const int steps = scan_diagonal(map_, c, h, v, block, emit);
      find_goal_diagonally(c, h, v, steps);
      if (steps < block) return;
      c = {c.x + block * step.x, c.y + block * step.y};
      if (frontier_.defer(id_, c, c, diagonal)) return;
    }
  }

  void follow_list(const JumpList& list, unsigned direction) {
    find_goal(from_, direction, list.ahead);
    for (const unsigned side : {lower, higher}) {
      const TurnRuns& runs = list.turns[side - 1];
      const unsigned turn = side_of(direction, side);
      find_goal(from_, turn, runs.straight);
      horizontal(turn) ? find_goal_diagonally(from_, turn, direction, runs.diagonal)
                       : find_goal_diagonally(from_, direction, turn, runs.diagonal);
    }
    for (const std::uint32_t next : list.reached) reach(next >> 2U, next & 3U);
  }

  /// Reaches the goal if it lies on the straight run from a cell, which is free for that many cells.
  void find_goal(Cell c, unsigned d, std::int32_t length) {
    const Cell along = grid_moves[d], to{frontier_.goal.x - c.x, frontier_.goal.y - c.y};
    const int ahead = to.x * along.x + to.y * along.y;
    if ((horizontal(d) ? to.y : to.x) == 0 && ahead > 0 && ahead <= length) reach_goal(d);
  }

  /// Reaches the goal if it lies on a diagonal run of that many steps, or straight beside it.
  void find_goal_diagonally(Cell c, unsigned h, unsigned v, std::int32_t steps) {
    const int dx = h == east ? 1 : -1, dy = v == north ? 1 : -1;
    const int to_column = dx * (frontier_.goal.x - c.x), to_row = dy * (frontier_.goal.y - c.y);
    const int to_line = std::min(to_column, to_row);
    if (to_line < 1 || to_line > steps) return;
    if (to_column == to_row) {
      reach_goal(h);
      return;
    }
    const Cell turn{c.x + to_line * dx, c.y + to_line * dy};
    const unsigned d = to_row == to_line ? h : v;
    auto ignore = [](Cell, unsigned) {};
    find_goal(turn, d, scan_straight(map_, turn, d, 0, ignore));
  }

  void reach_goal(unsigned d) { frontier_.reach(id_, frontier_.goal_node, d); }

  void reach(std::uint32_t number, unsigned d) {
    JumpPoint& point = memory_.lists[number];
    if (point.query != memory_.query) {
      if (point.cell == frontier_.start || point.cell == frontier_.goal) return;
      point.query = memory_.query;
      if (point.label == JumpPoint::none && frontier_.ends != nullptr)
        point.label = frontier_.ends->label(frontier_.state(point.cell));
      point.node = frontier_.nodes.add({point.cell, JumpNode::none, {}, number});
      frontier_.nodes[point.node].label = point.label;
    }
    frontier_.reach(id_, point.node, d);
  }

  const Map& map_;
  Memory& memory_;
  Frontier& frontier_;
  std::uint32_t id_ = 0;
  Cell from_;
};

/// Numbers the query, and forgets the jump points that are known if they take more than two bytes a cell,
/// from 16 MiB to 64.
void begin_query(Memory& memory, std::size_t cells) {
  const std::size_t most_bytes = std::clamp(2 * cells, std::size_t{16} << 20U, std::size_t{64} << 20U);
  if (memory.lists.bytes() > most_bytes || ++memory.query == 0) {
    memory.lists.clear();
    memory.query = 1;
  }
}

}  // namespace
}  // namespace jump

std::vector<Option> describe(JpsOptions& /*options*/) { return {}; }

Outcome<Plan> jps(const Problem& problem, const JpsOptions& /*options*/, const Budget& budget,
                  Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  if (query->ground.model != GridModel::cells) {
    return bad_input("jps takes grids of the model 'cells', not 'corners'; take a_star instead", "planner");
  }
  auto& memory = workspace.get<jump::Memory>();
  follow(
      memory.ground, problem.grid,
      [&] {
        memory.map = jump::map_of(query->ground);
        memory.ends.make(query->ground);
        memory.lists.clear();
      },
      [&](const auto& changed) {
        if (changed.empty()) return;
        jump::rewrite(memory.map, query->ground, changed);
        memory.ends.change();
        memory.lists.clear();
      });
  jump::begin_query(memory, query->ground.frame.size());
  return jump::search(problem, *query, memory.frontier, memory.ends, budget, workspace.trace,
                      jump::Expansion(memory));
}

}  // namespace outrider
