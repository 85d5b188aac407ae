#include "subgoals.hpp"

#include "grid/grid_runs.hpp"
#include "grid/jps/jps_index.hpp"
#include "grid/octile.hpp"

namespace outrider::hub_labelling {
namespace {

constexpr unsigned east = 0, north = 1, west = 2, north_east = 4, north_west = 5;

/// The straight components of a diagonal move.
struct Parts {
  unsigned horizontal, vertical;
};
constexpr Parts parts_of(unsigned diagonal) {
  return {diagonal == 4 || diagonal == 7 ? east : west, diagonal < 6 ? north : north + 2};
}

/// Returns true if both cells beside a diagonal move are free and the one to which it would lead is not.
bool at_convex_corner(unsigned moves) {
  for (unsigned move = 4; move < 8; ++move) {
    const auto [horizontal, vertical] = parts_of(move);
    if (((moves >> horizontal) & (moves >> vertical) & ~(moves >> move) & 1U) != 0) return true;
  }
  return false;
}

}  // namespace

OctileRuns octile_runs(const GridMap& ground, const std::stop_token& stop) {
  OctileRuns runs{std::vector<std::array<std::int16_t, 4>>(ground.marks.size()), ground.stride};
  constexpr std::array<unsigned, 4> moves = {east, north, north_east, north_west};
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const auto visit = [&](std::size_t v, std::size_t next) {
      runs.free[v][k] = static_cast<std::int16_t>(runs.free[next][k] + 1);
    };
    backwards_along(ground, moves[k], visit, stop);
  }
  return runs;
}

bool OctileRuns::leg(Cell a, Cell b) const {
  const Cell bend = bend_of(a, b);
  const Cell low = a.y < bend.y ? a : bend;
  if (moves(low, (b.x > a.x) == (b.y > a.y) ? 2 : 3) < std::abs(bend.y - a.y)) return false;
  const Cell first = bend.x < b.x || bend.y < b.y ? bend : b;
  return moves(first, bend.y == b.y ? 0 : 1) >= std::abs(b.x - bend.x) + std::abs(b.y - bend.y);
}

Subgoals subgoals_of(const GridMap& ground, const std::stop_token& stop) {
  Subgoals subgoals;
  subgoals.number.assign(ground.marks.size(), Subgoals::none);
  subgoals.ahead.resize(ground.marks.size());
  for (std::uint32_t v = 0; v < ground.moves.size(); ++v) {
    if (!at_convex_corner(ground.moves[v])) continue;
    subgoals.number[v] = static_cast<std::uint32_t>(subgoals.cells.size());
    subgoals.cells.push_back(ground.at(v));
  }
  for (unsigned move = 0; move < 4; ++move) {
    const auto visit = [&](std::size_t v, std::size_t next) {
      const bool here = subgoals.number[next] != Subgoals::none;
      const int beyond = subgoals.ahead[next][move];
      if (here || beyond > 0) subgoals.ahead[v][move] = static_cast<std::int16_t>(here ? 1 : beyond + 1);
    };
    backwards_along(ground, move, visit, stop);
  }
  return subgoals;
}

const std::vector<std::uint32_t>& SubgoalReach::from(Cell cell) {
  cell_ = cell;
  found_.clear();
  const std::size_t vertex = ground_.index(cell);
  std::array<std::uint32_t, 4> straight{};
  for (unsigned move = 0; move < 4; ++move) {
    straight[move] = ahead(vertex, move);
    find(straight[move], Subgoals::none);
  }
  for (unsigned move = 4; move < 8; ++move)
    diagonal(vertex, move, straight[parts_of(move).horizontal], straight[parts_of(move).vertical]);
  return found_;
}

/// Returns the next subgoal on a straight run, or none.
std::uint32_t SubgoalReach::ahead(std::size_t vertex, unsigned move) const {
  const std::int16_t steps = subgoals_.ahead[vertex][move];
  if (steps == 0) return Subgoals::none;
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(vertex) + steps * step_of(ground_, move);
  return subgoals_.number[static_cast<std::size_t>(at)];
}

/// Follows a diagonal run to its end or to the first subgoal on it. `last_level` and `last_upright` are the
/// last subgoals to its two sides, or none.
void SubgoalReach::diagonal(std::size_t vertex, unsigned move, std::uint32_t last_level,
                            std::uint32_t last_upright) {
  const auto [horizontal, vertical] = parts_of(move);
  const std::ptrdiff_t step = step_of(ground_, move);
  const auto look = [&](unsigned side, std::uint32_t& last) {
    const std::uint32_t subgoal = ahead(vertex, side);
    find(subgoal, last);
    if (subgoal != Subgoals::none) last = subgoal;
  };
  while (((ground_.moves[vertex] >> move) & 1U) != 0) {
    vertex = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(vertex) + step);
    if (subgoals_.number[vertex] != Subgoals::none) {
      find(subgoals_.number[vertex], Subgoals::none);
      return;
    }
    look(horizontal, last_level);
    look(vertical, last_upright);
  }
}

/// Adds a subgoal, unless a shortest path to it leads over the last one; both may be none.
void SubgoalReach::find(std::uint32_t subgoal, std::uint32_t last) {
  if (subgoal == Subgoals::none) return;
  if (last == Subgoals::none || !leads_over(subgoal, last)) found_.push_back(subgoal);
}

bool SubgoalReach::leads_over(std::uint32_t subgoal, std::uint32_t between) const {
  const Cell to = subgoals_.cells[subgoal], over = subgoals_.cells[between];
  const bool on_way = octile_distance(cell_, over) + octile_distance(over, to) == octile_distance(cell_, to);
  return on_way && (runs_.leg(over, to) || runs_.leg(to, over));
}

std::optional<TurnGraph> subgoal_graph(const GridMap& ground, const OctileRuns& runs,
                                       const Subgoals& subgoals, std::size_t most_edges,
                                       const std::stop_token& stop) {
  return graph_of(subgoals.cells.size(), most_edges, stop, [&] {
    return [&, reach = SubgoalReach(ground, runs, subgoals)](std::uint32_t subgoal) mutable {
      Fan<TurnGraph::Edge> edges;
      const Cell at = subgoals.cells[subgoal];
      for (const std::uint32_t to : reach.from(at))
        edges.level.push_back({{}, to, octile_distance(at, subgoals.cells[to]).value()});
      return edges;
    };
  });
}

}  // namespace outrider::hub_labelling
