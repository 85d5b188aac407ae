#include "outrider/path/hubs/octile_labels.hpp"

#include <algorithm>
#include <limits>

#include "hub_memory.hpp"
#include "octile_lists.hpp"
#include "outrider/path/grid/jps.hpp"
#include "outrider/path/grid/jps_plus.hpp"
#include "outrider/path/grid/line_of_sight.hpp"

namespace outrider {
namespace hub_labelling {
namespace {

// Work in expansions of jps_plus, from measured times; on a changed ground it compares all cells first.
constexpr std::uint64_t looks_an_expansion = 32, expansions_a_node = 8, cells_an_expansion = 1024;

/// Adds a leg from the last cell of `way`, with the cell at which it bends.
void add_leg(std::vector<Cell>& way, Cell bend, Cell to) {
  if (to == way.back()) return;
  if (bend != way.back() && bend != to) way.push_back(bend);
  way.push_back(to);
}

/// Index of the shortest paths along the moves, as hub_memory.hpp asks for it.
struct OctileIndex {
  OctileRuns runs;
  OctileLists labels;
  std::uint64_t work = 0;
  std::uint64_t work_of_search = 0;

  static std::unique_ptr<const OctileIndex> of(const GridMap& ground, std::size_t most_bytes,
                                               const std::stop_token& stop);

  [[nodiscard]] const OctileTileRow& row_of(Cell cell) const {
    return labels.rows[static_cast<std::size_t>(cell.y / tile_side)];
  }
  [[nodiscard]] bool lists(Cell cell) const { return !row_of(cell).tiles.empty(); }

  bool straight(const GridMap& /*ground*/, Cell start, Cell goal, std::vector<Cell>& way) const {
    if (!runs.leg(start, goal)) return false;
    add_leg(way, bend_of(start, goal), goal);
    return true;
  }
  static bool straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
    add_leg(way, bend_of(start, goal), goal);
    if (legal_way(ground, way)) return true;
    way.assign(1, start);
    return false;
  }
  bool find(Cell start, Cell goal, std::vector<Cell>& way) const;

  static Octile moves_of(const std::vector<Cell>& way) {
    Octile moves;
    for (std::size_t i = 1; i < way.size(); ++i) moves = moves + octile_distance(way[i - 1], way[i]);
    return moves;
  }
  static double length_of(const std::vector<Cell>& way) { return moves_of(way).value(); }
  static bool none_shorter(std::span<const CellBox> boxes, const std::vector<Cell>& way) {
    return none_shorter_over(boxes, way.front(), way.back(), moves_of(way));
  }
};

/// Builds the index. Returns nothing if it does not fit, or if `stop` is requested.
std::unique_ptr<const OctileIndex> OctileIndex::of(const GridMap& ground, std::size_t most_bytes,
                                                   const std::stop_token& stop) {
  constexpr std::size_t of_a_node = sizeof(HubTrees::HubNode) + sizeof(HubTrees::HubLabel);
  if (std::max(ground.frame.width, ground.frame.height) > longest_side_of_runs) return nullptr;
  OctileIndex index;
  const std::size_t bytes_of_runs = ground.marks.size() * sizeof(index.runs.free.front());
  if (bytes_of_runs > most_bytes / 2) return nullptr;
  const std::size_t left = most_bytes - bytes_of_runs;
  const Subgoals subgoals = subgoals_of(ground);
  const auto graph = subgoal_graph(ground, subgoals, left / sizeof(TurnGraph::Edge), stop);
  if (!graph) return nullptr;
  const auto trees = hub_trees(*graph, by_importance(*graph, stop), left / 2 / of_a_node, stop);
  if (!trees) return nullptr;
  const std::size_t bytes_of_nodes = trees->nodes.size() * sizeof(OctileNode);
  auto labels = octile_lists(ground, subgoals, *trees, left - bytes_of_nodes, stop);
  if (!labels || stop.stop_requested()) return nullptr;
  index.runs = octile_runs(ground);
  index.labels = std::move(*labels);
  std::uint64_t looks = 0;
  for (const OctileTileRow& row : index.labels.rows) looks += row.work;
  index.work = expansions_a_node * trees->nodes.size() + looks / looks_an_expansion;
  index.work_of_search = ground.frame.size() / cells_an_expansion;
  return std::make_unique<const OctileIndex>(std::move(index));
}

/// The list of a tile, read by one of its cells.
struct Reading {
  Reading(const OctileList& list, Cell of)
      : next(list.hubs.data()), end(next + list.hubs.size()), all(list), cell(of), bit(corner_bit(of)) {}
  [[nodiscard]] std::ptrdiff_t at() const { return next - all.hubs.data(); }
  [[nodiscard]] bool mine() const { return (all.cells[at()] & bit) != 0; }
  [[nodiscard]] const OctilePath& path() const { return all.paths[at()]; }
  /// Returns the distance to the hub.
  [[nodiscard]] Octile distance() const {
    const OctilePath& beyond = path();
    return octile_distance(cell, {beyond.x, beyond.y}) + Octile{beyond.straight, beyond.diagonal};
  }

  const std::uint32_t* next;
  const std::uint32_t* end;
  OctileList all;
  Cell cell;
  unsigned bit;
};

/// The nodes of the best common hub at which the two halves of a path meet.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint32_t start_node = 0, goal_node = 0;
};

Meeting best_meeting(Reading from, Reading to) {
  Meeting best;
  while (from.next != from.end && to.next != to.end) {
    const std::uint32_t hub = *from.next, other = *to.next;
    if (hub == other && from.mine() && to.mine()) {
      const double length = (from.distance() + to.distance()).value();
      if (length < best.length) best = {length, from.path().node, to.path().node};
    }
    const bool advance = hub < other || (hub == other && !from.mine());
    from.next += advance ? 1 : 0;
    to.next += advance ? 0 : 1;
  }
  return best;
}

/// Adds the path from the last cell of `way` over a node to its hub. The first leg is diagonal first, the
/// others are diagonal first from their end nearer to the hub.
void add_path(std::vector<Cell>& way, const std::vector<OctileNode>& nodes, std::uint32_t node) {
  add_leg(way, bend_of(way.back(), nodes[node].cell()), nodes[node].cell());
  for (; nodes[node].next != node; node = nodes[node].next) {
    const Cell next = nodes[nodes[node].next].cell();
    add_leg(way, bend_of(next, nodes[node].cell()), next);
  }
}

bool OctileIndex::find(Cell start, Cell goal, std::vector<Cell>& way) const {
  const Meeting meeting = best_meeting({row_of(start).at(start.x), start}, {row_of(goal).at(goal.x), goal});
  if (!(meeting.length < std::numeric_limits<double>::infinity())) return false;
  add_path(way, labels.nodes, meeting.start_node);
  const auto hub = static_cast<std::ptrdiff_t>(way.size());
  way.push_back(goal);
  add_path(way, labels.nodes, meeting.goal_node);
  way.pop_back();  // the hub again
  std::reverse(way.begin() + hub, way.end());
  return true;
}

}  // namespace
}  // namespace hub_labelling

std::vector<Option> describe(OctileLabelsOptions& options) {
  return {{"index_mib", "MiB", 1.0, 65536.0,
           "most memory for the index; where it does not fit, jps_plus answers", &options.index_mib}};
}

Outcome<Plan> octile_labels(const Problem& problem, const OctileLabelsOptions& options, const Budget& budget,
                            Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  const GridMap& ground = query->ground;
  if (ground.model != GridModel::cells) {
    return bad_input("octile_labels takes grids of the model 'cells', not 'corners'; take hub_labels instead",
                     "planner");
  }
  return hub_labelling::plan_by_hubs<hub_labelling::OctileIndex>(
      problem, *query, options.index_mib, budget, workspace, [&] {
        const bool fits =
            std::max(ground.frame.width, ground.frame.height) <= hub_labelling::longest_side_of_runs;
        return fits ? jps_plus(problem, {}, budget, workspace) : jps(problem, {}, budget, workspace);
      });
}

}  // namespace outrider
