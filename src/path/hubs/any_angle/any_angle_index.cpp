#include "any_angle_index.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/polyanya/polyanya_search.hpp"
#include "outrider/path/grid/line_of_sight.hpp"

namespace outrider::hub_labelling {
namespace {

using AnyAngleGraph = GuidedGraph<AnyAngleMetric>;

constexpr std::size_t most_turns = 65535;  // limit of the turn index in a list entry

// Work in expansions of polyanya, from measured times; a side is one of the mesh that polyanya makes first.
constexpr std::uint64_t looks_an_expansion = 16, expansions_a_node = 4, expansions_a_side = 2,
                        edges_an_expansion = 2;

std::vector<Cell> places_of(const NavigationMesh& mesh) {
  std::vector<Cell> places;
  places.reserve(mesh.turns.size());
  for (const NavigationMesh::Turn& turn : mesh.turns) places.push_back(turn.at);
  return places;
}

/// The shortest paths from the landmarks to all turns. A path may arrive at a turn such that it cannot go on;
/// its last leg then comes from a turn in sight at which it may bend, or from the landmark.
class LandmarkLengths {
 public:
  LandmarkLengths(const GridMap& ground, const NavigationMesh& mesh, const TurnGraph& graph,
                  const AnyAngleGraph& guided, const std::stop_token& stop)
      : ground_(ground),
        mesh_(mesh),
        guided_(guided),
        stop_(stop),
        arrive_(guided.landmarks.size()),
        seen_(arrive_.size()) {
    parallel_for(arrive_.size(), stop_, [&](std::size_t k) {
      TautSight sight(ground, mesh);
      const Cell at = place(k);
      std::vector<FirstLeg<AnyAngleMetric>> legs;
      for (const std::uint32_t turn : sight.from(at)) {
        const Cell to = guided.at[turn];
        legs.push_back({turn, {to.x - at.x, to.y - at.y}, length_between(at, to)});
      }
      arrive_[k] = lengths_from<AnyAngleMetric>(graph, guided, legs);
      seen_[k].resize(guided.turns());
      for (const std::uint32_t turn : sight.all_from(at)) seen_[k][turn] = true;
    });
  }

  [[nodiscard]] std::vector<AnyAngleGraph::Lengths> all() const {
    constexpr std::size_t block = 64;  // turns of a task
    std::vector<AnyAngleGraph::Lengths> lengths(guided_.turns());
    parallel_for((lengths.size() + block - 1) / block, stop_, [&](std::size_t task) {
      TautSight sight(ground_, mesh_);
      const std::size_t end = std::min(lengths.size(), (task + 1) * block);
      for (std::size_t turn = task * block; turn < end; ++turn) lengths[turn] = of(turn, sight);
    });
    return lengths;
  }

 private:
  [[nodiscard]] Cell place(std::size_t k) const { return guided_.at[guided_.landmarks[k]]; }

  [[nodiscard]] AnyAngleGraph::Lengths of(std::size_t turn, TautSight& sight) const {
    const Cell at = guided_.at[turn];
    std::array<double, most_landmarks> least;
    least.fill(AnyAngleMetric::far());
    for (std::size_t k = 0; k < arrive_.size(); ++k)
      least[k] =
          seen_[k][turn] || guided_.landmarks[k] == turn ? length_between(place(k), at) : arrive_[k][turn];
    for (const std::uint32_t seen : sight.from(at)) {
      const double leg = length_between(guided_.at[seen], at);
      for (std::size_t k = 0; k < arrive_.size(); ++k)
        least[k] = std::min(least[k], guided_.landmarks[k] == seen ? leg : arrive_[k][seen] + leg);
    }
    AnyAngleGraph::Lengths rounded{};
    std::transform(least.begin(), least.end(), rounded.begin(), AnyAngleMetric::stored);
    return rounded;
  }

  const GridMap& ground_;
  const NavigationMesh& mesh_;
  const AnyAngleGraph& guided_;
  const std::stop_token& stop_;
  std::vector<std::vector<double>> arrive_;  ///< by landmark and turn
  std::vector<std::vector<bool>> seen_;
};

/// Builds the labels; returns nothing if they do not fit. `work` becomes the work of building them.
std::optional<AnyAngleLabels> labels_of(const GridMap& ground, const NavigationMesh& mesh,
                                        const TurnGraph& graph, std::size_t most_bytes,
                                        const std::stop_token& stop, std::uint64_t& work) {
  constexpr std::size_t of_a_node =
      sizeof(HubTrees::HubNode) + sizeof(HubTrees::HubLabel) + sizeof(TautDepartures::Departure);
  if (mesh.turns.size() > most_turns) return std::nullopt;
  auto trees = hub_trees(graph, by_importance(graph, stop), most_bytes / 2 / of_a_node,
                         most_work_for(most_bytes) / 4, stop);
  if (!trees) return std::nullopt;
  const ListLimits limits{most_bytes - trees->nodes.size() * sizeof(HubTrees::HubNode),
                          most_work_for(most_bytes)};
  auto rows = hub_lists(ground, mesh, *trees, taut_departures(mesh, *trees), limits, stop);
  if (!rows) return std::nullopt;
  std::uint64_t looks = 0;
  for (const TileRow& row : *rows) looks += row.work;
  work = expansions_a_node * trees->nodes.size() + looks / looks_an_expansion;
  return AnyAngleLabels{StoredArray(places_of(mesh)), StoredArray(std::move(trees->nodes)), std::move(*rows)};
}

/// Lengths of the shortest paths from the landmarks to a corner.
EndLengths<AnyAngleMetric> lengths_to(const GridMap& ground, const AnyAngleGraph& graph,
                                      const GuidedEnd& end) {
  auto lengths = lengths_over(graph, end);
  for (std::size_t k = 0; k < graph.landmarks.size(); ++k) {
    const Cell landmark = graph.at[graph.landmarks[k]];
    const double direct = length_between(landmark, end.at);
    if (direct < lengths[k] && visible(ground, landmark, end.at)) lengths[k] = direct;
  }
  return lengths;
}

/// Returns true if a search among the turns expands at most as much as one on the mesh, over a few queries
/// between turns. In a narrow maze it does not: there the mesh knows which turns a corridor forces.
bool leads_better(const AnyAngleIndex& index, const GridMap& ground, const std::stop_token& stop) {
  constexpr std::size_t probes = 16;
  const StoredArray<Cell>& places = index.turns->graph.at;
  const auto probe = [&](std::size_t i) { return places[i % probes * places.size() / probes]; };
  polyanya_search::Memory memory;
  if (!memory.renew(std::shared_ptr<const GridMap>(std::shared_ptr<void>(), &ground), stop)) return false;
  AnyAngleIndex::Scratch scratch;
  Budget budget;
  budget.stop = stop;
  BudgetMeter among_turns(budget), on_mesh(budget);
  for (std::size_t i = 0; i < probes; ++i) {
    const Cell start = probe(i), goal = probe(7 * i + 3);
    std::vector<Cell> way;
    if (start == goal || AnyAngleIndex::straight_on(ground, start, goal, way)) continue;
    index.find(ground, start, goal, way, scratch, among_turns);
    static_cast<void>(polyanya_search::Search(memory, {ground, start, goal}, nullptr).run(on_mesh));
  }
  return among_turns.spent() <= on_mesh.spent();
}

}  // namespace

std::unique_ptr<const AnyAngleIndex> AnyAngleIndex::of(const GridMap& ground, std::size_t most_bytes,
                                                       const std::stop_token& stop, bool try_labels) {
  constexpr std::size_t bytes_an_edge = 12;  // of the budget, while the graph is built
  const std::size_t bytes_of_cells =
      ground.frame.size() * sizeof(decltype(NavigationMesh::polygon_of)::value_type);
  if (bytes_of_cells > most_bytes / 2) return nullptr;  // the mesh holds a polygon for each
  NavigationMesh mesh = navigation_mesh(ground, stop);
  if (stop.stop_requested()) return nullptr;
  const auto graph = turn_graph(ground, mesh, most_bytes / bytes_an_edge, stop);
  if (!graph) return nullptr;
  AnyAngleIndex index;
  index.work_of_search = expansions_a_side * mesh.sides.size();
  if (try_labels) index.labels = labels_of(ground, mesh, *graph, most_bytes, stop, index.work);
  if (stop.stop_requested()) return nullptr;
  if (!index.labels) {
    if (try_labels && !worth_guiding(*graph)) return nullptr;
    AnyAngleGraph guided = with_landmarks<AnyAngleMetric>(*graph, places_of(mesh));
    guided.lengths = StoredArray(LandmarkLengths(ground, mesh, *graph, guided, stop).all());
    if (stop.stop_requested() || guided.memory() + mesh.memory() > most_bytes) return nullptr;
    index.work = guided.to.size() / edges_an_expansion;
    index.turns = std::make_unique<const AnyAngleTurns>(AnyAngleTurns{std::move(mesh), std::move(guided)});
    if (try_labels && !leads_better(index, ground, stop)) return nullptr;
  }
  return std::make_unique<const AnyAngleIndex>(std::move(index));
}

bool AnyAngleIndex::straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
  if (!visible(ground, start, goal)) return false;
  way.push_back(goal);
  return true;
}

Found AnyAngleIndex::find(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way,
                          Scratch& scratch, BudgetMeter& meter) const {
  if (labels) return labels->find(start, goal, way) ? Found::way : Found::no_path;
  const AnyAngleGraph& graph = turns->graph;
  if (!scratch.sight) scratch.sight.emplace(ground, turns->mesh);
  for (GuidedEnd* end : {&scratch.search.start, &scratch.search.goal}) {
    end->at = end == &scratch.search.start ? start : goal;
    end->turns = scratch.sight->from(end->at);
    end->passable = !ground.pinch(end->at);
  }
  const Found found = find_guided(graph, lengths_to(ground, graph, scratch.search.start),
                                  lengths_to(ground, graph, scratch.search.goal), scratch.search, meter);
  const std::vector<Cell>& places = scratch.search.places;
  if (found == Found::way) way.insert(way.end(), places.begin() + 1, places.end());
  return found;
}

double AnyAngleIndex::length_of(const std::vector<Cell>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += length_between(way[i - 1], way[i]);
  return length;
}

}  // namespace outrider::hub_labelling
