#include "outrider/path/grid/jps.hpp"

#include "grid_follow.hpp"
#include "jps_map.hpp"
#include "jps_search.hpp"

namespace outrider {
namespace jump {
namespace {

struct Memory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the map
  Map map;
  Frontier frontier;
};

/// The lines along one of the two straight directions of a diagonal run, with three moving windows of bits.
struct Side {
  const std::uint64_t* line;  // through the present cell
  std::ptrdiff_t step;        // to the line of the next cell
  std::int32_t position;      // position of the first bit of the windows
  std::uint64_t blocked, ahead, ends_behind = 0, ends_here, ends_ahead;

  Side(const Map& map, unsigned d, Cell c, bool up)
      : line(map.line(d, c)),
        step(up ? map.lines[d].stride : -map.lines[d].stride),
        position(map.position(d, c)),
        blocked(window(line, position)),
        ahead(window(line + step, position)),
        ends_here(ends(blocked)),
        ends_ahead(ends(ahead)) {}

  void advance() {
    line += step;
    ends_behind = ends_here;
    ends_here = ends_ahead;
    blocked = ahead;
    ahead = window(line + step, position);
    ends_ahead = ends(ahead);
  }
  /// Returns true if the diagonal step to bit i of the next line meets a blocked cell.
  [[nodiscard]] bool bars(unsigned i) const {
    return (((blocked >> i) & 1U) | ((ahead >> (i - 1)) & 3U)) != 0;
  }
  /// Finds where the straight run from bit i stops within the windows; 0 if it does not.
  [[nodiscard]] std::uint64_t stop(unsigned i) const {
    const std::uint64_t stops = (ends_behind | ends_ahead | blocked) & (~std::uint64_t{1} << i);
    return stops & (~stops + 1);
  }
  /// Returns the sides on which a turn is forced at a stop.
  [[nodiscard]] unsigned sides(std::uint64_t stop) const {
    const unsigned behind = step > 0 ? lower : higher;
    return ((ends_behind & stop) != 0 ? behind : 0U) |
           ((ends_ahead & stop) != 0 ? lower + higher - behind : 0U);
  }
};

class Expansion {
 public:
  Expansion(const Map& map, Frontier& frontier) : map_(map), frontier_(frontier) {}

  void operator()(std::uint32_t id) {
    const JumpNode node = frontier_.nodes[id];
    id_ = id;
    from_ = node.cell;
    if (node.parent == id) {
      for (const unsigned d : {east, north, west, south}) run(from_, d);
      for (const unsigned h : {east, west}) {
        for (const unsigned v : {north, south}) run_diagonally(h, v);
      }
      return;
    }
    run(from_, node.direction);
    for (const unsigned side : {lower, higher}) {
      if ((node.sides & side) == 0) continue;
      const unsigned turn = side_of(node.direction, side);
      run(from_, turn);
      horizontal(turn) ? run_diagonally(turn, node.direction) : run_diagonally(node.direction, turn);
    }
  }

 private:
  /// Follows the straight run from a cell; `ahead` cells of it are known to be free and without a turn.
  void run(Cell c, unsigned d, std::int32_t ahead = 0) {
    const std::int32_t p = map_.position(d, c);
    const Stop stop = scan(map_.line(d, c), map_.lines[d].stride, p + ahead);
    if (horizontal(d) ? frontier_.goal.y == c.y : frontier_.goal.x == c.x) {
      const std::int32_t goal = map_.position(d, frontier_.goal);
      if (goal > p && goal <= stop.position) {
        frontier_.reach(id_, frontier_.goal, d, 0);
        return;
      }
    }
    if (stop.sides != 0) frontier_.reach(id_, map_.cell(d, c, stop.position), d, stop.sides);
  }

  /// Follows the straight run from a cell of a diagonal; bit i of the windows is that cell.
  void run(const Side& side, unsigned i, Cell c, unsigned d) {
    const std::uint64_t stop = side.stop(i);
    if ((stop & side.blocked) != 0) return;
    if (stop == 0) {
      run(c, d, 63 - static_cast<std::int32_t>(i));
    } else {
      const std::int32_t position = side.position + std::countr_zero(stop);
      frontier_.reach(id_, map_.cell(d, c, position), d, side.sides(stop));
    }
  }

  void run_diagonally(unsigned h, unsigned v) {
    constexpr int most_steps = 32;
    const int dx = h == east ? 1 : -1, dy = v == north ? 1 : -1;
    const Cell goal = frontier_.goal;
    for (Cell c = from_;;) {
      Side rows(map_, h, c, v == north);
      Side columns(map_, v, c, h == east);
      const int to_row = dy * (goal.y - c.y), to_column = dx * (goal.x - c.x);
      for (int i = 1; i <= most_steps; ++i) {
        if (rows.bars(static_cast<unsigned>(i))) return;
        rows.advance();
        columns.advance();
        const Cell here{c.x + i * dx, c.y + i * dy};
        if (i == to_row && i == to_column) {
          frontier_.reach(id_, here, h, 0);
          return;
        }
        i == to_row ? run(here, h) : run(rows, static_cast<unsigned>(i), here, h);
        i == to_column ? run(here, v) : run(columns, static_cast<unsigned>(i), here, v);
      }
      c = {c.x + most_steps * dx, c.y + most_steps * dy};
    }
  }

  const Map& map_;
  Frontier& frontier_;
  std::uint32_t id_ = 0;
  Cell from_;
};

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
      memory.ground, problem.grid, [&] { memory.map = jump::map_of(query->ground); },
      [&](const auto& changed) { jump::rewrite(memory.map, query->ground, changed); });
  return jump::search(problem, *query, memory.frontier, budget, workspace.trace,
                      jump::Expansion(memory.map, memory.frontier));
}

}  // namespace outrider
