// Poses from which the optimisation of a pose graph can start.
#pragma once

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

template <class Pose>
struct GraphStart {
  std::vector<Pose> poses;
  std::string name;
};

/// Returns the poses of the nodes.
template <class Pose>
std::vector<Pose> poses_of(const PoseGraphOf<Pose>& graph) {
  std::vector<Pose> poses;
  for (const auto& node : graph.nodes) poses.push_back(node.pose);
  return poses;
}

/// Lists the edges at each node.
template <class Pose>
std::vector<std::vector<std::uint32_t>> edges_at_nodes(const PoseGraphOf<Pose>& graph);

/// Returns the index of the pose that stays where it is.
template <class Pose>
std::uint32_t first_pose(const PoseGraphOf<Pose>& graph);

/// Returns the start of that name: given; odometry (each pose from the one before it in the file, where an
/// edge joins them, the rest as below); spanning_tree (from the first pose breadth first, so with as few
/// edges as possible between); or chordal. A graph whose pose-to-pose edges do not join all poses has no
/// chordal start, and one whose edges place not every node has only that given.
template <class Pose>
Outcome<GraphStart<Pose>> graph_start(const PoseGraphOf<Pose>& graph, const std::string& name);

/// The chordal relaxation (Carlone et al., ICRA 2015, 4597-4604, section III-B and eq. 5): the linear least
/// squares of the rotations as free matrices, each then replaced by the nearest rotation, and the linear
/// least squares of the positions for these rotations.
template <class Pose>
Outcome<std::vector<Pose>> chordal_poses(const PoseGraphOf<Pose>& graph);

}  // namespace outrider
