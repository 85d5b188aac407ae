#include "outrider/path/hubs/hub_labels.hpp"

#include <algorithm>
#include <limits>

#include "hub_lists.hpp"
#include "hub_memory.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "outrider/path/mesh/polyanya.hpp"

namespace outrider {
namespace hub_labelling {
namespace {

constexpr std::size_t most_turns = 65535;  // limit of the turn index in a list entry

// Work in expansions of polyanya, from measured times; a side is one of the mesh that polyanya makes first.
constexpr std::uint64_t looks_an_expansion = 16, expansions_a_node = 4, expansions_a_side = 2;

/// Index of the shortest paths in any direction, as hub_memory.hpp asks for it.
struct AnyAngleIndex {
  std::vector<Cell> turns;
  std::vector<HubTrees::HubNode> nodes;
  std::vector<TileRow> rows;
  std::uint64_t work = 0;
  std::uint64_t work_of_search = 0;

  static std::unique_ptr<const AnyAngleIndex> of(const GridMap& ground, std::size_t most_bytes,
                                                 const std::stop_token& stop);

  [[nodiscard]] const TileRow& row_of(Cell corner) const {
    return rows[static_cast<std::size_t>(corner.y / tile_side)];
  }
  [[nodiscard]] bool lists(Cell corner) const { return !row_of(corner).tiles.empty(); }

  static bool straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
    if (!visible(ground, start, goal)) return false;
    way.push_back(goal);
    return true;
  }
  static bool straight(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
    return straight_on(ground, start, goal, way);
  }
  bool find(Cell start, Cell goal, std::vector<Cell>& way) const;

  static double length_of(const std::vector<Cell>& way) {
    double length = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) length += length_between(way[i - 1], way[i]);
    return length;
  }
  static bool none_shorter(std::span<const CellBox> boxes, const std::vector<Cell>& way) {
    return length_of(way) <= least_length_over(boxes, way.front(), way.back());
  }
};

/// Returns the number of expansions of polyanya that take about as long as building the index: graph and
/// trees by their nodes, lists by the entries visited.
std::uint64_t work_of(const AnyAngleIndex& index) {
  std::uint64_t looks = 0;
  for (const TileRow& row : index.rows) looks += row.work;
  return expansions_a_node * index.nodes.size() + looks / looks_an_expansion;
}

/// Builds the index. Returns nothing if its hubs do not fit into half of `most_bytes`, or if `stop` is
/// requested.
std::unique_ptr<const AnyAngleIndex> AnyAngleIndex::of(const GridMap& ground, std::size_t most_bytes,
                                                       const std::stop_token& stop) {
  constexpr std::size_t of_a_node =
      sizeof(HubTrees::HubNode) + sizeof(HubTrees::HubLabel) + sizeof(TautDepartures::Departure);
  const NavigationMesh mesh = navigation_mesh(ground);
  if (mesh.turns.size() > most_turns) return nullptr;
  const auto graph = turn_graph(ground, mesh, most_bytes / sizeof(TurnGraph::Edge), stop);
  if (!graph) return nullptr;
  auto trees = hub_trees(*graph, by_importance(*graph, stop), most_bytes / 2 / of_a_node, stop);
  if (!trees) return nullptr;
  AnyAngleIndex index;
  for (const NavigationMesh::Turn& turn : mesh.turns) index.turns.push_back(turn.at);
  const std::size_t left = most_bytes - trees->nodes.size() * of_a_node;
  index.rows = hub_lists(ground, mesh, *trees, taut_departures(mesh, *trees), left, stop);
  if (stop.stop_requested()) return nullptr;
  index.nodes = std::move(trees->nodes);
  index.nodes.shrink_to_fit();
  index.work = work_of(index);
  index.work_of_search = expansions_a_side * mesh.sides.size();
  return std::make_unique<const AnyAngleIndex>(std::move(index));
}

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

/// The point at which the two halves of a path meet: nodes of the same hub.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint32_t start_node = 0, goal_node = 0;
};

class Query {
 public:
  Query(const AnyAngleIndex& index, Cell start, Cell goal)
      : index_(index), nodes_(index.nodes), start_(start), goal_(goal) {}

  /// Adds the shortest path that turns, without the start; returns false if there is none.
  bool find_way(std::vector<Cell>& way) const {
    const Meeting meeting = best_meeting();
    if (!(meeting.length < std::numeric_limits<double>::infinity())) return false;
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
  [[nodiscard]] Cell at(std::uint32_t node) const { return index_.turns[nodes_[node].turn]; }
  [[nodiscard]] Meeting exactly(Meeting meeting) const {
    meeting.length = length_between(start_, at(meeting.start_node)) + nodes_[meeting.start_node].distance +
                     nodes_[meeting.goal_node].distance + length_between(at(meeting.goal_node), goal_);
    return meeting;
  }

  /// Finds the best meeting. Distances in the lists are rounded, so those close to the least are computed
  /// again.
  [[nodiscard]] Meeting best_meeting() const {
    constexpr double rounding = 1.0 + 4.0 * std::numeric_limits<float>::epsilon();
    Reading from(index_.row_of(start_).at(start_.x), start_);
    Reading to(index_.row_of(goal_).at(goal_.x), goal_);
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

  const AnyAngleIndex& index_;
  const std::vector<HubTrees::HubNode>& nodes_;
  Cell start_, goal_;
};

bool AnyAngleIndex::find(Cell start, Cell goal, std::vector<Cell>& way) const {
  return Query(*this, start, goal).find_way(way);
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
  if (query->ground.model != GridModel::corners) {
    return bad_input("hub_labels takes grids of the model 'corners', not 'cells'; take octile_labels instead",
                     "planner");
  }
  return hub_labelling::plan_by_hubs<hub_labelling::AnyAngleIndex>(
      problem, *query, options.index_mib, budget, workspace,
      [&] { return polyanya(problem, {}, budget, workspace); });
}

}  // namespace outrider
