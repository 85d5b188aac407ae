#include "octile_index.hpp"

#include <algorithm>
#include <limits>

namespace outrider::hub_labelling {
namespace {

using OctileGraph = GuidedGraph<OctileMetric>;

// Work in expansions of jps_plus, from measured times; on a changed ground it compares all cells first.
constexpr std::uint64_t looks_an_expansion = 32, expansions_a_node = 8, cells_an_expansion = 1024,
                        edges_an_expansion = 4;

std::size_t memory_of(const Subgoals& subgoals) {
  return subgoals.cells.size() * sizeof(Cell) +
         subgoals.number.size() * (sizeof(std::uint32_t) + sizeof(subgoals.ahead.front()));
}

/// Builds the labels; returns nothing if they do not fit. `work` becomes the work of building them.
std::optional<OctileLists> labels_of(const GridMap& ground, const OctileRuns& runs, const Subgoals& subgoals,
                                     const TurnGraph& graph, std::size_t most_bytes,
                                     const std::stop_token& stop, std::uint64_t& work) {
  constexpr std::size_t of_a_node = sizeof(HubTrees::HubNode) + sizeof(HubTrees::HubLabel);
  const auto trees = hub_trees(graph, by_importance(graph, stop), most_bytes / of_a_node,
                               most_work_for(most_bytes) / 4, stop);
  if (!trees) return std::nullopt;
  const ListLimits limits{most_bytes - trees->nodes.size() * sizeof(OctileNode), most_work_for(most_bytes)};
  auto labels = octile_lists(ground, runs, subgoals, *trees, limits, stop);
  if (!labels) return std::nullopt;
  std::uint64_t looks = 0;
  for (const OctileTileRow& row : labels->rows) looks += row.work;
  work = expansions_a_node * trees->nodes.size() + looks / looks_an_expansion;
  return labels;
}

/// Lengths of the shortest paths from the landmarks to all subgoals.
std::vector<OctileGraph::Lengths> landmark_lengths(const TurnGraph& graph, const OctileGraph& guided,
                                                   const std::stop_token& stop) {
  std::vector<OctileGraph::Lengths> lengths(guided.turns());
  parallel_for(guided.landmarks.size(), stop, [&](std::size_t k) {
    const FirstLeg<OctileMetric> here{guided.landmarks[k], {}, {}};
    const auto exact = lengths_from<OctileMetric>(graph, guided, {&here, 1});
    for (std::size_t turn = 0; turn < exact.size(); ++turn) {
      if (exact[turn] < OctileMetric::far()) lengths[turn][k] = OctileMetric::stored(exact[turn]);
    }
  });
  return lengths;
}

/// Puts the subgoal of a cell, or those that it reaches, into an end.
void set_end(GuidedEnd& end, Cell cell, const Subgoals& subgoals, const GridMap& ground,
             SubgoalReach& reach) {
  end.at = cell;
  const std::uint32_t own = subgoals.number[ground.index(cell)];
  if (own == Subgoals::none) {
    end.turns = reach.from(cell);
  } else {
    end.turns.assign(1, own);
  }
}

}  // namespace

std::unique_ptr<const OctileIndex> OctileIndex::of(const GridMap& ground, std::size_t most_bytes,
                                                   const std::stop_token& stop, bool try_labels) {
  constexpr std::size_t bytes_an_edge = 12;  // of the budget, while the graph is built
  if (std::max(ground.frame.width, ground.frame.height) > longest_side_of_runs) return nullptr;
  OctileIndex index;
  const std::size_t bytes_of_runs = ground.marks.size() * sizeof(index.runs.free.front());
  if (bytes_of_runs > most_bytes / 2) return nullptr;
  const std::size_t left = most_bytes - bytes_of_runs;
  index.runs = octile_runs(ground, stop);
  Subgoals subgoals = subgoals_of(ground, stop);
  if (stop.stop_requested()) return nullptr;
  const auto graph = subgoal_graph(ground, index.runs, subgoals, left / bytes_an_edge, stop);
  if (!graph) return nullptr;
  index.work_of_search = ground.frame.size() / cells_an_expansion;
  if (try_labels) index.labels = labels_of(ground, index.runs, subgoals, *graph, left, stop, index.work);
  if (stop.stop_requested()) return nullptr;
  if (!index.labels) {
    if (try_labels && !worth_guiding(*graph)) return nullptr;
    OctileGraph guided = with_landmarks<OctileMetric>(*graph, subgoals.cells);
    guided.lengths = StoredArray(landmark_lengths(*graph, guided, stop));
    if (stop.stop_requested() || guided.memory() + memory_of(subgoals) > left) return nullptr;
    index.work = guided.to.size() / edges_an_expansion;
    index.subgoals =
        std::make_unique<const OctileSubgoals>(OctileSubgoals{std::move(subgoals), std::move(guided)});
  }
  return std::make_unique<const OctileIndex>(std::move(index));
}

bool OctileIndex::straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
  way.push_back(bend_of(start, goal));
  way.push_back(goal);
  if (legal_way(ground, way)) return true;
  way.assign(1, start);
  return false;
}

Found OctileIndex::find(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way,
                        Scratch& scratch, BudgetMeter& meter) const {
  if (labels) return find_in(*labels, start, goal, way) ? Found::way : Found::no_path;
  const auto& [cells, graph] = *subgoals;
  if (!scratch.reach) scratch.reach.emplace(ground, runs, cells);
  GuidedMemory<OctileMetric>& search = scratch.search;
  set_end(search.start, start, cells, ground, *scratch.reach);
  set_end(search.goal, goal, cells, ground, *scratch.reach);
  const Found found =
      find_guided(graph, lengths_over(graph, search.start), lengths_over(graph, search.goal), search, meter);
  if (found != Found::way) return found;
  const std::vector<Cell>& places = search.places;
  for (std::size_t i = 1; i < places.size(); ++i) {  // the last leg is diagonal first from the goal
    const bool last = i + 1 == places.size();
    way.push_back(last ? bend_of(places[i], places[i - 1]) : bend_of(places[i - 1], places[i]));
    way.push_back(places[i]);
  }
  return found;
}

}  // namespace outrider::hub_labelling
