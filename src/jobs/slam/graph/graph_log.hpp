// The log of a solved pose graph, as it is seen from above.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "outrider/log/log.hpp"
#include "recordings.hpp"

namespace outrider {

using NodeIndex = std::uint32_t;

constexpr double graph_step_s = 0.1;  ///< graphs have no times

/// Paths of robots through a graph: consecutive poses, each joined to the next by an edge.
class Ways {
 public:
  template <class Pose>
  explicit Ways(const PoseGraphOf<Pose>& graph) : step_of_(graph.nodes.size(), 0) {
    for (const auto& node : graph.nodes) is_point_.push_back(node.is_point ? 1 : 0);
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const auto& edge = graph.edges[i];
      if (edge.kind == EdgeKind::pose) edge_between_.try_emplace(std::minmax(edge.from, edge.to), i);
    }
    std::optional<NodeIndex> before;
    for (NodeIndex node = 0; node < graph.nodes.size(); ++node) {
      if (is_point_[node] != 0) continue;
      if (!before || !edge_between_.contains({*before, node})) all_.emplace_back();
      step_of_[node] = all_.back().size();
      all_.back().push_back(node);
      before = node;
    }
  }

  [[nodiscard]] const std::vector<std::vector<NodeIndex>>& all() const { return all_; }
  /// Returns the first of the longest paths.
  [[nodiscard]] const std::vector<NodeIndex>& main() const {
    return *std::ranges::max_element(all_, {}, &std::vector<NodeIndex>::size);
  }
  /// Returns the time at which a pose was reached; every robot starts at 0.
  [[nodiscard]] double time_s(NodeIndex node) const {
    return graph_step_s * static_cast<double>(step_of_[node]);
  }
  [[nodiscard]] bool follow(NodeIndex a, NodeIndex b) const {
    const auto [first, second] = std::minmax(a, b);
    return step_of_[second] == step_of_[first] + 1 && next_to(first, second);
  }
  /// Returns the edge that joins a pose of a path to the next.
  [[nodiscard]] std::size_t edge(NodeIndex from, NodeIndex to) const { return edge_between_.at({from, to}); }

 private:
  [[nodiscard]] bool next_to(NodeIndex a, NodeIndex b) const {
    for (NodeIndex node = a + 1; node < b; ++node) {
      if (is_point_[node] == 0) return false;
    }
    return true;
  }

  std::vector<std::uint8_t> is_point_;
  std::vector<std::size_t> step_of_;  ///< by node: its position in its path
  std::map<std::pair<NodeIndex, NodeIndex>, std::size_t> edge_between_;
  std::vector<std::vector<NodeIndex>> all_;
};

/// A solved graph from above; vectors are by node.
struct PlanGraph {
  PoseGraph graph;  ///< its names, and which nodes the edges join; not what they measure
  std::vector<Pose2> poses;
  std::vector<Pose2> odometry;               ///< along each path, from its first pose
  std::vector<Eigen::Matrix3d> covariances;  ///< of x, y and heading; or empty
  std::vector<Vec2> truth;                   ///< positions in the frame of the map; or empty
  std::string start;                         ///< where the optimisation began
  std::vector<std::string> refused;          ///< edges refused, as "from 1 to 2"
};

/// Logs the graph. The longest path is that of the robot. A graph is solved at once, so the believed poses
/// are the final poses. Returns the metrics of the log.
Metrics log_graph(Log& to, const SlamScenario& scenario, const PlanGraph& solved);

}  // namespace outrider
