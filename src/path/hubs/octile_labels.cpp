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
    way.push_back(bend_of(start, goal));
    way.push_back(goal);
    return true;
  }
  static bool straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
    way.push_back(bend_of(start, goal));
    way.push_back(goal);
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
  index.runs = octile_runs(ground);
  const Subgoals subgoals = subgoals_of(ground);
  const auto graph = subgoal_graph(ground, index.runs, subgoals, left / sizeof(TurnGraph::Edge), stop);
  if (!graph) return nullptr;
  const auto trees = hub_trees(*graph, by_importance(*graph, stop), left / of_a_node, stop);
  if (!trees) return nullptr;
  const std::size_t bytes_of_nodes = trees->nodes.size() * sizeof(OctileNode);
  auto labels = octile_lists(ground, index.runs, subgoals, *trees, left - bytes_of_nodes, stop);
  if (!labels || stop.stop_requested()) return nullptr;
  index.labels = std::move(*labels);
  std::uint64_t looks = 0;
  for (const OctileTileRow& row : index.labels.rows) looks += row.work;
  index.work = expansions_a_node * trees->nodes.size() + looks / looks_an_expansion;
  index.work_of_search = ground.frame.size() / cells_an_expansion;
  return std::make_unique<const OctileIndex>(std::move(index));
}

/// The nodes of the best common hub at which the two halves of a path meet.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint32_t start_node = 0, goal_node = 0;
};

/// An end of the query with the row of its list.
struct End {
  Cell cell;
  const OctileTileRow& row;
  unsigned bit = corner_bit(cell);

  [[nodiscard]] Octile distance(const OctilePath& path) const {
    return octile_distance(cell, {path.x, path.y}) + Octile{path.straight, path.diagonal};
  }
};

/// Takes the hubs that two blocks of the same number have in common, until none can be better.
void take_common(const End& start, const HubBlock& a, const End& goal, const HubBlock& b, double least,
                 Meeting& best) {
  for (std::uint64_t bits = a.bits & b.bits; bits != 0 && best.length > least; bits &= bits - 1) {
    const std::uint64_t bit = bits & (~bits + 1);
    const std::size_t i = a.path_of(bit), j = b.path_of(bit);
    if ((start.row.cells[i] & start.bit) == 0 || (goal.row.cells[j] & goal.bit) == 0) continue;
    const OctilePath &from = start.row.paths[i], &to = goal.row.paths[j];
    const double length = (start.distance(from) + goal.distance(to)).value();
    if (length < best.length) best = {length, from.node, to.node};
  }
}

Meeting best_meeting(const End& start, const End& goal) {
  Meeting best;
  const double least = octile_distance(start.cell, goal.cell).value();  // of any path
  const std::span<const HubBlock> from = start.row.at(start.cell.x), to = goal.row.at(goal.cell.x);
  auto a = from.begin(), b = to.begin();
  while (a != from.end() && b != to.end() && best.length > least) {
    if (a->block == b->block) {
      for (auto copy = b; copy != to.end() && copy->block == a->block; ++copy)
        take_common(start, *a, goal, *copy, least, best);
      ++a;
    } else {
      a->block < b->block ? ++a : ++b;
    }
  }
  return best;
}

/// Adds the path from the last cell of `way` over a node to its hub. The first leg is diagonal first, the
/// others are diagonal first from their end nearer to the hub. Bends may equal an end of their leg.
void add_path(std::vector<Cell>& way, const std::vector<OctileNode>& nodes, const OctileNode* node) {
  way.push_back(bend_of(way.back(), node->cell()));
  way.push_back(node->cell());
  for (const OctileNode* next = &nodes[node->next]; next != node; next = &nodes[node->next]) {
    way.push_back(bend_of(next->cell(), node->cell()));
    way.push_back(next->cell());
    node = next;
  }
}

bool OctileIndex::find(Cell start, Cell goal, std::vector<Cell>& way) const {
  const Meeting meeting = best_meeting({start, row_of(start)}, {goal, row_of(goal)});
  if (!(meeting.length < std::numeric_limits<double>::infinity())) return false;
  add_path(way, labels.nodes, &labels.nodes[meeting.start_node]);
  const auto hub = static_cast<std::ptrdiff_t>(way.size());
  way.push_back(goal);
  add_path(way, labels.nodes, &labels.nodes[meeting.goal_node]);
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
