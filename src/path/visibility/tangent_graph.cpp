#include "tangent_graph.hpp"

#include <algorithm>

#include "tangent_update.hpp"

namespace outrider {
namespace {

struct SweptMemory : TangentGraph {};
struct PairedMemory : TangentGraph {};
struct ImplicitMemory : TangentGraph {};

using Departures = void (*)(const PolygonGround&, const Place&, Node, std::vector<Departure>&,
                            std::uint64_t&);

/// Builds the graph from each pair once; the reverse leg touches the same arcs in the opposite direction.
Status build(TangentGraph& graph, Departures find, BudgetMeter& meter) {
  const PolygonGround& ground = *graph.ground;
  const auto nodes = static_cast<Node>(graph.first.size());
  std::vector<std::vector<Departure>> by_node(nodes);
  std::vector<Departure> found;
  for (Node node = 0; node < nodes; ++node) {
    if (!meter.spend()) return meter.refusal();
    found.clear();
    find(ground, place_of(ground, node), (node | 1U) + 1, found, graph.tests);
    for (const Departure& leg : found) {
      by_node[node].push_back(leg);
      by_node[turned_round(leg.to)].push_back(way_back(ground, node, leg));
    }
  }
  graph.take(std::move(by_node));
  return {};
}

Outcome<TangentGraph*> built(TangentGraph& graph, const std::shared_ptr<const PolygonGround>& ground,
                             Departures find, const Budget& budget) {
  if (graph.ground == ground) return &graph;
  Budget unhurried = budget;
  unhurried.expansions = std::numeric_limits<std::uint64_t>::max();
  BudgetMeter meter(unhurried);
  if (graph.ground) {
    auto updated = update_legs(graph, ground, meter);
    if (!updated) return pass_on(updated);
    if (*updated) return &graph;
  }
  graph.begin(ground);
  if (auto done = build(graph, find, meter); !done) {
    graph.ground = nullptr;
    return pass_on(done);
  }
  return &graph;
}

}  // namespace

void TangentGraph::begin(const std::shared_ptr<const PolygonGround>& on) {
  ground = on;
  legs.clear();
  first.assign(2 * on->arcs.size(), unknown);
  count.assign(2 * on->arcs.size(), 0);
  tests = 0;
}

void TangentGraph::look_round(Node node) {
  if (first[node] != unknown) return;
  std::vector<Departure> found;
  departures_swept(*ground, place_of(*ground, node), 0, found, tests);
  first[node] = static_cast<std::uint32_t>(legs.size());
  count[node] = static_cast<std::uint32_t>(found.size());
  legs.insert(legs.end(), found.begin(), found.end());
}

void TangentGraph::take(std::vector<std::vector<Departure>> rows) {
  for (Node node = 0; node < rows.size(); ++node) {
    std::vector<Departure>& row = rows[node];
    std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.to < b.to; });
    first[node] = static_cast<std::uint32_t>(legs.size());
    count[node] = static_cast<std::uint32_t>(row.size());
    legs.insert(legs.end(), row.begin(), row.end());
  }
}

Outcome<TangentGraph*> tangent_graph(const std::shared_ptr<const PolygonGround>& ground, TangentForm form,
                                     const Budget& budget, Workspace& workspace) {
  switch (form) {
    case TangentForm::swept: return built(workspace.get<SweptMemory>(), ground, departures_swept, budget);
    case TangentForm::paired:
      return built(workspace.get<PairedMemory>(), ground, departures_pairwise, budget);
    case TangentForm::implicit: break;
  }
  TangentGraph& graph = workspace.get<ImplicitMemory>();
  graph.begin(ground);
  return &graph;
}

}  // namespace outrider
