#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/small_cholesky.hpp"
#include "covariances.hpp"
#include "graph/graph_edges.hpp"
#include "graph/graph_starts.hpp"

namespace outrider {
namespace {

constexpr double largest = 1e9;

bool bounded(const Pose2& pose) {
  return std::abs(pose.position.x) <= largest && std::abs(pose.position.y) <= largest &&
         std::abs(pose.heading_rad) <= largest;
}

bool bounded(const Pose3& pose) {
  return position_of(pose).cwiseAbs().maxCoeff() <= largest &&
         (rotation_of(pose).transpose() * rotation_of(pose) - Eigen::Matrix3d::Identity()).norm() < 1e-6;
}

template <class Pose>
std::string name_of(const PoseGraphOf<Pose>& graph, const GraphEdgeOf<Pose>& edge) {
  return fmt::format("the edge from {} to {}", graph.nodes[edge.from].name, graph.nodes[edge.to].name);
}

/// Returns true if the information, with ones for the missing dimensions of the residual, is positive
/// definite.
template <class Pose>
bool positive_definite(const GraphEdgeOf<Pose>& edge) {
  if (!is_symmetric(edge.information)) return false;
  const Eigen::Index rows = residual_rows<Pose>(edge.kind);
  PoseMatrix<Pose> information = edge.information;
  for (Eigen::Index i = 0; i < freedoms<Pose>; ++i) {
    for (Eigen::Index j = 0; j < freedoms<Pose>; ++j) {
      if (std::max(i, j) < rows) continue;
      if (information(i, j) != 0.0) return false;
      information(i, j) = i == j ? 1.0 : 0.0;
    }
  }
  return SmallCholesky<freedoms<Pose>>(information).is_positive();
}

template <class Pose>
Status check_edge(const PoseGraphOf<Pose>& graph, const GraphEdgeOf<Pose>& edge) {
  if (edge.from >= graph.nodes.size() || edge.to >= graph.nodes.size()) {
    return bad_input(fmt::format("an edge joins nodes {} and {} of {}; name nodes that exist", edge.from,
                                 edge.to, graph.nodes.size()));
  }
  const auto refuse = [&](std::string_view why) {
    return bad_input(fmt::format("{} {}", name_of(graph, edge), why));
  };
  if (edge.from == edge.to) return refuse("joins a node to itself; take it out");
  const bool is_point = graph.nodes[edge.to].is_point;
  if (edge.kind != EdgeKind::range && graph.nodes[edge.from].is_point)
    return refuse("starts at a point; it starts at a pose");
  if ((edge.kind == EdgeKind::pose && is_point) || (edge.kind == EdgeKind::point && !is_point)) {
    return refuse("is of the wrong kind; a point is seen as a point, a pose as a pose");
  }
  if (!bounded(edge.measured)) return refuse("measures more than 1e9, or no number");
  if (!positive_definite(edge))
    return refuse("has an information that is not symmetric and positive definite");
  return {};
}

}  // namespace

template <class Pose>
Status check(const PoseGraphOf<Pose>& graph) {
  const bool has_pose =
      std::any_of(graph.nodes.begin(), graph.nodes.end(), [](const auto& node) { return !node.is_point; });
  if (!has_pose) return bad_input("the graph has no poses; expected at least one");
  if (graph.edges.empty()) return bad_input("the graph has no edges; expected at least one");
  for (const auto& node : graph.nodes) {
    if (!bounded(node.pose))
      return bad_input(fmt::format("node {} stands beyond 1e9, or nowhere", node.name));
  }
  for (const auto& edge : graph.edges) {
    if (auto ok = check_edge(graph, edge); !ok) return ok;
  }
  const std::vector<std::vector<std::uint32_t>> reach = edges_at_nodes(graph);
  std::vector<bool> reached(graph.nodes.size(), false);
  std::vector<std::uint32_t> queue = {0};
  reached[0] = true;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const std::uint32_t i : reach[queue[next]]) {
      for (const std::uint32_t node : {graph.edges[i].from, graph.edges[i].to}) {
        if (reached[node]) continue;
        reached[node] = true;
        queue.push_back(node);
      }
    }
  }
  if (queue.size() == graph.nodes.size()) return {};
  const auto apart = std::find(reached.begin(), reached.end(), false) - reached.begin();
  return bad_input(fmt::format("the graph falls apart: no chain of edges joins node {} to node {}; add one",
                               graph.nodes[static_cast<std::size_t>(apart)].name, graph.nodes.front().name));
}

template <class Pose>
PoseGraphOf<Pose> in_measured_frame(PoseGraphOf<Pose> graph) {
  constexpr int D = dimension<Pose>;
  for (auto& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) continue;
    PoseMatrix<Pose> turn = PoseMatrix<Pose>::Identity();
    turn.template topLeftCorner<D, D>() = rotation_of(edge.measured);
    const PoseMatrix<Pose> information = turn * edge.information * turn.transpose();
    edge.information = 0.5 * (information + information.transpose());
  }
  return graph;
}

template Status check(const PoseGraph&);
template Status check(const PoseGraph3&);
template PoseGraph in_measured_frame(PoseGraph);
template PoseGraph3 in_measured_frame(PoseGraph3);

}  // namespace outrider
