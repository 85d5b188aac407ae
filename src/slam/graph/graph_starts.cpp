#include "graph/graph_starts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/graph_edges.hpp"
#include "outrider/geometry/spatial_pose.hpp"

namespace outrider {
namespace {

Pose2 wrapped(const Pose2& pose) { return wrap_heading(pose); }
Pose3 wrapped(const Pose3& pose) { return pose; }

/// Computes the pose of the far node of an edge from the near one; returns false if the edge does not
/// determine it.
template <class Pose>
bool place(PoseGraphOf<Pose>& graph, const GraphEdgeOf<Pose>& edge, std::uint32_t near) {
  if (edge.kind == EdgeKind::range || (near == edge.to && edge.kind != EdgeKind::pose)) return false;
  if (near == edge.from) {
    Pose pose = wrapped(compose(graph.nodes[near].pose, edge.measured));
    if (graph.nodes[edge.to].is_point) {
      const auto position = pose.position;
      pose = {};
      pose.position = position;
    }
    graph.nodes[edge.to].pose = pose;
    return true;
  }
  graph.nodes[edge.from].pose = wrapped(compose(graph.nodes[edge.to].pose, inverse(edge.measured)));
  return true;
}

/// Places each pose from the one before it in the file, where an edge joins them, beginning at the first.
template <class Pose>
void place_by_odometry(PoseGraphOf<Pose>& graph, std::vector<bool>& placed) {
  std::vector<std::uint32_t> before(graph.nodes.size(), 0);  // by node: the edge to it, plus one
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    const bool next = edge.kind == EdgeKind::pose && edge.to == edge.from + 1;
    if (next && before[edge.to] == 0) before[edge.to] = i + 1;
  }
  for (std::uint32_t node = 1; node < graph.nodes.size(); ++node) {
    if (placed[node] || before[node] == 0 || !placed[node - 1]) continue;
    placed[node] = place(graph, graph.edges[before[node] - 1], node - 1);
  }
}

}  // namespace

/// Lists the edges at each node.
template <class Pose>
std::vector<std::vector<std::uint32_t>> edges_at_nodes(const PoseGraphOf<Pose>& graph) {
  std::vector<std::vector<std::uint32_t>> reach(graph.nodes.size());
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    reach[graph.edges[i].from].push_back(i);
    reach[graph.edges[i].to].push_back(i);
  }
  return reach;
}

template <class Pose>
Status place_from_edges(PoseGraphOf<Pose>& graph, std::vector<bool> placed) {
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
  const auto reach = edges_at_nodes(graph);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t near = queue[next];
    for (const std::uint32_t i : reach[near]) {
      const auto& edge = graph.edges[i];
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

template <class Pose>
std::uint32_t first_pose(const PoseGraphOf<Pose>& graph) {
  const auto first =
      std::find_if(graph.nodes.begin(), graph.nodes.end(), [](const auto& node) { return !node.is_point; });
  return static_cast<std::uint32_t>(first - graph.nodes.begin());
}

template <class Pose>
Outcome<GraphStart<Pose>> graph_start(const PoseGraphOf<Pose>& graph, const std::string& name) {
  if (name == "given") return GraphStart<Pose>{poses_of(graph), name};
  if (name == "chordal") {
    auto poses = chordal_poses(graph);
    if (!poses) return pass_on(poses);
    return GraphStart<Pose>{std::move(*poses), name};
  }
  PoseGraphOf<Pose> copy = graph;
  std::vector<bool> placed(graph.nodes.size(), false);
  placed[first_pose(graph)] = true;
  if (name == "odometry") place_by_odometry(copy, placed);
  if (auto ok = place_from_edges(copy, placed); !ok) return bad_input(ok.error().sentence, "start");
  return GraphStart<Pose>{poses_of(copy), name};
}

template std::vector<std::vector<std::uint32_t>> edges_at_nodes(const PoseGraph&);
template std::vector<std::vector<std::uint32_t>> edges_at_nodes(const PoseGraph3&);
template Status place_from_edges(PoseGraph&, std::vector<bool>);
template Status place_from_edges(PoseGraph3&, std::vector<bool>);
template std::uint32_t first_pose(const PoseGraph&);
template std::uint32_t first_pose(const PoseGraph3&);
template Outcome<GraphStart<Pose2>> graph_start(const PoseGraph&, const std::string&);
template Outcome<GraphStart<Pose3>> graph_start(const PoseGraph3&, const std::string&);

}  // namespace outrider
