#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "covariances.hpp"
#include "graph_edges.hpp"

namespace outrider {
namespace {

constexpr double largest = 1e9;

bool bounded(const Pose2& pose) {
  return std::abs(pose.position.x) <= largest && std::abs(pose.position.y) <= largest &&
         std::abs(pose.heading_rad) <= largest;
}

std::string name_of(const PoseGraph& graph, const GraphEdge& edge) {
  return fmt::format("the edge from {} to {}", graph.nodes[edge.from].name, graph.nodes[edge.to].name);
}

Eigen::Index dimension(EdgeKind kind) { return kind == EdgeKind::pose ? 3 : kind == EdgeKind::point ? 2 : 1; }

/// Returns true if the information, with ones for the missing dimensions of the residual, is positive
/// definite.
bool positive_definite(const GraphEdge& edge) {
  if (!is_symmetric(edge.information)) return false;
  Eigen::Matrix3d information = edge.information;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      if (std::max(i, j) < dimension(edge.kind)) continue;
      if (information(i, j) != 0.0) return false;
      information(i, j) = i == j ? 1.0 : 0.0;
    }
  }
  return information.llt().info() == Eigen::Success;
}

Status check_edge(const PoseGraph& graph, const GraphEdge& edge) {
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

using Reach = std::vector<std::vector<std::uint32_t>>;
/// Lists the edges at each node.
Reach edges_at_nodes(const PoseGraph& graph) {
  Reach reach(graph.nodes.size());
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    reach[graph.edges[i].from].push_back(i);
    reach[graph.edges[i].to].push_back(i);
  }
  return reach;
}

/// Computes the pose of the far node of an edge from the near one; returns false if the edge does not
/// determine it.
bool place(PoseGraph& graph, const GraphEdge& edge, std::uint32_t near) {
  if (edge.kind == EdgeKind::range) return false;
  if (near == edge.from) {
    Pose2 pose = wrap_heading(compose(graph.nodes[near].pose, edge.measured));
    if (graph.nodes[edge.to].is_point) pose.heading_rad = 0.0;
    graph.nodes[edge.to].pose = pose;
    return true;
  }
  if (edge.kind != EdgeKind::pose) return false;
  const Pose2& to = graph.nodes[edge.to].pose;
  const double heading_rad = to.heading_rad - edge.measured.heading_rad;
  graph.nodes[edge.from].pose =
      wrap_heading({to.position - rotated(heading_rad, edge.measured.position), heading_rad});
  return true;
}

}  // namespace

Status check(const PoseGraph& graph) {
  const bool has_pose = std::any_of(graph.nodes.begin(), graph.nodes.end(),
                                    [](const GraphNode& node) { return !node.is_point; });
  if (!has_pose) return bad_input("the graph has no poses; expected at least one");
  if (graph.edges.empty()) return bad_input("the graph has no edges; expected at least one");
  for (const GraphNode& node : graph.nodes) {
    if (!bounded(node.pose))
      return bad_input(fmt::format("node {} stands beyond 1e9, or nowhere", node.name));
  }
  for (const GraphEdge& edge : graph.edges) {
    if (auto ok = check_edge(graph, edge); !ok) return ok;
  }
  const Reach reach = edges_at_nodes(graph);
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

PoseGraph in_measured_frame(PoseGraph graph) {
  for (GraphEdge& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) continue;
    const Eigen::Matrix3d turn = rotation_by(edge.measured.heading_rad);
    const Eigen::Matrix3d information = turn * edge.information * turn.transpose();
    edge.information = 0.5 * (information + information.transpose());
  }
  return graph;
}

Status place_from_edges(PoseGraph& graph, std::vector<bool> placed) {
  std::vector<std::uint32_t> queue;
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    if (placed[node]) queue.push_back(node);
  }
  for (std::uint32_t node = 0; queue.empty() && node < graph.nodes.size(); ++node) {
    if (graph.nodes[node].is_point) continue;
    graph.nodes[node].pose = {};
    placed[node] = true;
    queue.push_back(node);
  }
  const Reach reach = edges_at_nodes(graph);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t near = queue[next];
    for (const std::uint32_t i : reach[near]) {
      const GraphEdge& edge = graph.edges[i];
      const std::uint32_t far = edge.from == near ? edge.to : edge.from;
      if (placed[far] || !place(graph, edge, near)) continue;
      placed[far] = true;
      queue.push_back(far);
    }
  }
  const auto lost = std::find(placed.begin(), placed.end(), false);
  if (lost == placed.end()) return {};
  const auto& name = graph.nodes[static_cast<std::size_t>(lost - placed.begin())].name;
  return bad_input(
      fmt::format("the edges do not say where node {} stands; give it a place or an edge", name));
}

}  // namespace outrider
