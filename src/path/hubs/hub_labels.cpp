#include "outrider/path/hubs/hub_labels.hpp"

#include <algorithm>
#include <limits>

#include "hub_kept.hpp"
#include "hub_lists.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/path/mesh/polyanya.hpp"

namespace outrider {
namespace hub_labelling {
namespace {

struct Index {
  std::vector<Cell> turns;
  HubTrees trees;
  std::vector<TileRow> rows;
  std::uint64_t work = 0;          ///< work of building it, in expansions of polyanya
  std::uint64_t work_of_mesh = 0;  ///< work of building the mesh of polyanya
};

constexpr std::size_t most_turns = 65535;  // limit of the turn index in a list entry

// Work in expansions of polyanya, from measured times; a side is one of the mesh that polyanya makes first.
constexpr std::uint64_t looks_an_expansion = 16, expansions_a_node = 4, expansions_a_side = 2;

/// Returns the number of expansions of polyanya that take about as long as building the index: graph and
/// trees by their nodes, lists by the entries visited.
std::uint64_t work_of(const Index& index) {
  std::uint64_t looks = 0;
  for (const TileRow& row : index.rows) looks += row.work;
  return expansions_a_node * index.trees.nodes.size() + looks / looks_an_expansion;
}

/// Builds the index. Returns nothing if its hubs do not fit into half of `most_bytes`, or if `stop` is
/// requested.
std::unique_ptr<const Index> index_of(const GridMap& ground, std::size_t most_bytes,
                                      const std::stop_token& stop) {
  constexpr std::size_t of_a_node =
      sizeof(HubTrees::HubNode) + sizeof(HubTrees::HubLabel) + sizeof(HubTrees::Departure);
  const NavigationMesh mesh = navigation_mesh(ground);
  if (mesh.turns.size() > most_turns) return nullptr;
  const auto graph = turn_graph(ground, mesh, most_bytes / sizeof(TurnGraph::Edge), stop);
  if (!graph) return nullptr;
  auto trees = hub_trees(mesh, *graph, by_importance(*graph, stop), most_bytes / 2 / of_a_node, stop);
  if (!trees) return nullptr;
  Index index;
  for (const NavigationMesh::Turn& turn : mesh.turns) index.turns.push_back(turn.at);
  index.trees = std::move(*trees);
  const std::size_t left = most_bytes - index.trees.nodes.size() * of_a_node;
  index.rows = hub_lists(ground, mesh, index.trees, left, stop);
  if (stop.stop_requested()) return nullptr;
  index.work = work_of(index);
  index.work_of_mesh = expansions_a_side * mesh.sides.size();
  index.trees.keep_paths_alone();
  return std::make_unique<const Index>(std::move(index));
}

struct Memory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the index
  std::int64_t index_mib = 0;
  std::unique_ptr<const Index> index;    ///< none when it would be too large
  std::shared_ptr<const GridMap> asked;  ///< ground of the last query; differs from `ground` in few cells
  bool changed = false;                  ///< some cells differ
  bool searched = false;                 ///< polyanya has been used and has built its mesh
  std::vector<CellBox> freed;            ///< blocked in `ground`, free in `asked`
  std::uint64_t spent = 0;               ///< work of polyanya on changed grounds, in expansions
  std::vector<Cell> way;

  void renew(const std::shared_ptr<const GridMap>& now, std::int64_t mib, const std::stop_token& stop) {
    const bool made = ground != nullptr && index_mib == mib;
    const bool near = made && (asked == now || compare(now));
    if (near && (!changed || index == nullptr || spent <= index->work)) return;
    make(now, mib, stop);
  }

  /// Compares the grounds; returns false if too many cells differ.
  bool compare(const std::shared_ptr<const GridMap>& now) {
    const auto cells = cells_changed(*ground, *now, now->frame.size() / 32);
    if (!cells) return false;
    changed = !cells->empty();
    searched = false;
    freed = freed_boxes(*now, *cells);
    asked = now;
    return true;
  }

  void make(const std::shared_ptr<const GridMap>& now, std::int64_t mib, const std::stop_token& stop) {
    ground.reset();
    asked.reset();
    freed.clear();
    changed = searched = false;
    spent = 0;
    index = index_of(*now, static_cast<std::size_t>(mib) << 20U, stop);
    if (stop.stop_requested()) return;
    ground = asked = now;
    index_mib = mib;
  }

  [[nodiscard]] const TileRow& row_of(Cell corner) const {
    return index->rows[static_cast<std::size_t>(corner.y / tile_side)];
  }
  [[nodiscard]] bool lists(Cell corner) const { return !row_of(corner).tiles.empty(); }
};

/// The list of a tile, read by one of its corners.
struct Reading {
  Reading(const TileList& list, Cell of)
      : next(list.entries.data()),
        end(next + list.entries.size()),
        turns(list.turns.data()),
        corner(of),
        bit(corner_bit(of)) {}
  [[nodiscard]] bool mine() const { return (next->corners & bit) != 0; }
  /// Returns the distance to the hub, cells.
  [[nodiscard]] double distance() const {
    return length_between(corner, turns[next->turn]) + static_cast<double>(next->beyond);
  }

  const HubEntry* next;
  const HubEntry* end;
  const Cell* turns;
  Cell corner;
  unsigned bit;
};

double length_of(const std::vector<Cell>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += length_between(way[i - 1], way[i]);
  return length;
}

/// The point at which the two halves of a path meet: nodes of the same hub.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint32_t start_node = 0, goal_node = 0;
};

class Query {
 public:
  Query(Memory& memory, Cell start, Cell goal)
      : memory_(memory), nodes_(memory.index->trees.nodes), start_(start), goal_(goal) {}

  /// Finds the shortest path that turns, including both ends; returns false if there is none.
  bool find_way() {
    const Meeting meeting = best_meeting();
    if (!(meeting.length < std::numeric_limits<double>::infinity())) return false;
    std::vector<Cell>& way = memory_.way;
    way.push_back(start_);
    for (std::uint32_t node = meeting.start_node;; node = nodes_[node].next) {
      way.push_back(at(node));
      if (nodes_[node].next == node) break;
    }
    const auto middle = static_cast<std::ptrdiff_t>(way.size());
    for (std::uint32_t node = meeting.goal_node; nodes_[node].next != node; node = nodes_[node].next)
      way.push_back(at(node));
    std::reverse(way.begin() + middle, way.end());
    way.push_back(goal_);
    return true;
  }

 private:
  [[nodiscard]] Cell at(std::uint32_t node) const { return memory_.index->turns[nodes_[node].turn]; }
  [[nodiscard]] Meeting exactly(Meeting meeting) const {
    meeting.length = length_between(start_, at(meeting.start_node)) + nodes_[meeting.start_node].distance +
                     nodes_[meeting.goal_node].distance + length_between(at(meeting.goal_node), goal_);
    return meeting;
  }

  /// Finds the best meeting. Distances in the lists are rounded, so those close to the least are computed
  /// again.
  Meeting best_meeting() {
    constexpr double rounding = 1.0 + 4.0 * std::numeric_limits<float>::epsilon();
    Reading from(memory_.row_of(start_).at(start_.x), start_);
    Reading to(memory_.row_of(goal_).at(goal_.x), goal_);
    Meeting best;
    double least = std::numeric_limits<double>::infinity();
    while (from.next != from.end && to.next != to.end) {
      const std::uint32_t hub = from.next->hub, other = to.next->hub;
      if (hub == other && from.mine() && to.mine()) {
        const double rounded = from.distance() + to.distance();
        if (rounded <= least * rounding) {
          least = std::min(least, rounded);
          const Meeting meeting = exactly({0.0, from.next->node, to.next->node});
          if (meeting.length < best.length) best = meeting;
        }
      }
      const bool advance = hub < other || (hub == other && !from.mine());
      from.next += advance ? 1 : 0;
      to.next += advance ? 0 : 1;
    }
    return best;
  }

  Memory& memory_;
  const std::vector<HubTrees::HubNode>& nodes_;
  Cell start_, goal_;
};

enum class Answer { way, no_path, unknown };

/// Answers a query as far as the index proves an answer on the present ground; the path is in memory.way.
Answer look_up(Memory& memory, Cell start, Cell goal) {
  std::vector<Cell>& way = memory.way;
  way.assign(1, start);
  if (start == goal) return Answer::way;
  way.push_back(goal);
  if (visible(*memory.asked, start, goal)) return Answer::way;
  way.clear();
  if (!memory.lists(start) || !memory.lists(goal)) return Answer::unknown;
  if (!memory.changed) return Query(memory, start, goal).find_way() ? Answer::way : Answer::no_path;

  const GridMap& before = *memory.ground;
  if (!before.place(start) || !before.place(goal) || visible(before, start, goal)) return Answer::unknown;
  if (!Query(memory, start, goal).find_way()) return memory.freed.empty() ? Answer::no_path : Answer::unknown;
  const bool shortest = length_of(way) <= least_length_over(memory.freed, start, goal);
  return shortest && legal_way(*memory.asked, way) ? Answer::way : Answer::unknown;
}

/// Answers by polyanya; on a changed ground its work counts towards the next index.
Outcome<Plan> search_instead(const Problem& problem, const Budget& budget, Workspace& workspace,
                             Memory& memory) {
  auto plan = polyanya(problem, {}, budget, workspace);
  if (!memory.changed) return plan;
  if (!memory.searched) memory.spent += memory.index->work_of_mesh;
  memory.searched = true;
  if (plan) memory.spent += plan->counters.expansions;
  return plan;
}

}  // namespace
}  // namespace hub_labelling

std::vector<Option> describe(HubLabelsOptions& options) {
  return {{"index_mib", "MiB", 1.0, 65536.0,
           "most memory for the index; where it does not fit, polyanya answers", &options.index_mib}};
}

Outcome<Plan> hub_labels(const Problem& problem, const HubLabelsOptions& options, const Budget& budget,
                         Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  const auto& [ground, start, goal] = *query;
  if (ground.model != GridModel::corners) {
    return bad_input("hub_labels takes grids of the model 'corners', not 'cells'; take jps_plus instead",
                     "planner");
  }
  BudgetMeter meter(budget);
  if (!meter.spend()) return meter.refusal();
  auto& memory = workspace.get<hub_labelling::Memory>();
  memory.renew(problem.grid, options.index_mib, budget.stop);
  if (memory.ground == nullptr) return meter.refusal();
  if (memory.index == nullptr) return polyanya(problem, {}, budget, workspace);

  const auto answer = hub_labelling::look_up(memory, start, goal);
  if (answer == hub_labelling::Answer::unknown)
    return hub_labelling::search_instead(problem, budget, workspace, memory);
  if (answer == hub_labelling::Answer::no_path)
    return fault(FaultCode::no_path, "nothing joins the start and the goal");
  double cost = hub_labelling::length_of(memory.way);  // cells
  if (workspace.trace != nullptr)
    workspace.trace->record({ground.index(start), ground.index(start), cost, 0.0, cost});
  cost *= ground.frame.resolution_m;
  return plan_along(problem, memory.way, cost, cost, {meter.spent(), 0, 0});
}

}  // namespace outrider
