#include "outrider/path/hub_labels.hpp"

#include <algorithm>
#include <limits>

#include "hub_lists.hpp"
#include "outrider/path/line_of_sight.hpp"
#include "outrider/path/polyanya.hpp"

namespace outrider {
namespace hub_labelling {
namespace {

struct Index {
  NavigationMesh mesh;
  HubTrees trees;
  std::vector<TileRow> rows;
};

constexpr std::size_t most_turns = 65535;  // that an entry of a list can name

/// Nothing when its hubs do not fit into half of `most_bytes`, or when `stop` asks for it.
std::unique_ptr<const Index> index_of(const GridGround& ground, std::size_t most_bytes,
                                      const std::stop_token& stop) {
  constexpr std::size_t of_a_node =
      sizeof(HubTrees::Node) + sizeof(HubTrees::Label) + sizeof(HubTrees::Departure);
  Index index{navigation_mesh(ground), {}, {}};
  if (index.mesh.turns.size() > most_turns) return nullptr;
  const auto graph = turn_graph(ground, index.mesh, most_bytes / sizeof(TurnGraph::Edge), stop);
  if (!graph) return nullptr;
  auto trees = hub_trees(index.mesh, *graph, by_importance(*graph, stop), most_bytes / 2 / of_a_node, stop);
  if (!trees) return nullptr;
  index.trees = std::move(*trees);
  const std::size_t left = most_bytes - index.trees.nodes.size() * of_a_node;
  index.rows = hub_lists(ground, index.mesh, index.trees, left, stop);
  if (stop.stop_requested()) return nullptr;
  if (!index.rows.back().tiles.empty()) index.trees.keep_paths_alone();
  return std::make_unique<const Index>(std::move(index));
}

struct Memory {
  std::shared_ptr<const GridGround> ground;  ///< of the index
  std::int64_t index_mib = 0;
  std::unique_ptr<const Index> index;  ///< none when it would be too large
  std::unique_ptr<ListMaker> at_start, at_goal;
  std::vector<Cell> way;

  void renew(const std::shared_ptr<const GridGround>& now, std::int64_t mib, const std::stop_token& stop) {
    if (ground == now && index_mib == mib) return;
    ground.reset();
    at_start.reset();
    at_goal.reset();
    index = index_of(*now, static_cast<std::size_t>(mib) << 20U, stop);
    if (stop.stop_requested()) return;
    ground = now;
    index_mib = mib;
  }

  TileList list_of(Cell corner, std::unique_ptr<ListMaker>& maker) const {
    const TileRow& row = index->rows[static_cast<std::size_t>(corner.y / tile_side)];
    if (!row.tiles.empty()) return row.at(corner.x);
    if (!maker) maker = std::make_unique<ListMaker>(*ground, index->mesh, index->trees);
    maker->add(corner);
    return maker->list();
  }
};

/// The list of a tile as one of its corners reads it.
struct Reading {
  Reading(const TileList& list, Cell of)
      : next(list.entries.data()),
        end(next + list.entries.size()),
        turns(list.turns.data()),
        corner(of),
        bit(corner_bit(of)) {}
  [[nodiscard]] bool mine() const { return (next->corners & bit) != 0; }
  /// To the hub, cells.
  [[nodiscard]] double distance() const {
    return length_between(corner, turns[next->turn]) + static_cast<double>(next->beyond);
  }

  const Entry* next;
  const Entry* end;
  const Cell* turns;
  Cell corner;
  unsigned bit;
};

/// Where the two halves of a way meet: nodes of the same hub.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint32_t start_node = 0, goal_node = 0;
};

class Query {
 public:
  Query(Memory& memory, Cell start, Cell goal)
      : memory_(memory), nodes_(memory.index->trees.nodes), start_(start), goal_(goal) {}

  /// The shortest way that turns, with both ends; false when there is none.
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
  [[nodiscard]] Cell at(std::uint32_t node) const { return memory_.index->mesh.turns[nodes_[node].turn].at; }
  [[nodiscard]] Meeting exactly(Meeting meeting) const {
    meeting.length = length_between(start_, at(meeting.start_node)) + nodes_[meeting.start_node].distance +
                     nodes_[meeting.goal_node].distance + length_between(at(meeting.goal_node), goal_);
    return meeting;
  }

  /// Distances in the lists are rounded: those that come near the least are reckoned anew.
  Meeting best_meeting() {
    constexpr double rounding = 1.0 + 4.0 * std::numeric_limits<float>::epsilon();
    Reading from(memory_.list_of(start_, memory_.at_start), start_);
    Reading to(memory_.list_of(goal_, memory_.at_goal), goal_);
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
  const std::vector<HubTrees::Node>& nodes_;
  Cell start_, goal_;
};

}  // namespace
}  // namespace hub_labelling

std::vector<Option> describe(HubLabelsOptions& options) {
  return {{"index_mib", "MiB", 1.0, 65536.0,
           "most memory for the index; what does not fit is reckoned anew at each query",
           &options.index_mib}};
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

  std::vector<Cell>& way = memory.way;
  way.clear();
  if (start == goal) {
    way = {start};
  } else if (visible(ground, start, goal)) {
    way = {start, goal};
  } else if (!hub_labelling::Query(memory, start, goal).find_way()) {
    return fault(FaultCode::no_path, "nothing joins the start and the goal");
  }
  double cost = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) cost += hub_labelling::length_between(way[i - 1], way[i]);
  if (workspace.trace != nullptr)
    workspace.trace->record({ground.index(start), ground.index(start), cost, 0.0, cost});
  cost *= ground.frame.resolution_m;
  return plan_along(problem, way, cost, cost, {meter.spent(), 0, 0});
}

}  // namespace outrider
