// Pose graphs of several robots in the PyFG format: VERTEX_SE2 and VERTEX_XY give the true poses; EDGE_SE2
// (odometry), EDGE_SE2_XY and EDGE_RANGE give the measurements with their covariances as upper triangles. The
// name of a pose is a letter for the robot and a number.
//
// The first pose of each robot is placed at its true pose, because the start is known. All others are placed
// by the edges. Faults: bad_input with file:line, the error and the remedy. Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

struct TrueGraph {
  PoseGraph graph;
  std::vector<Pose2> truth;  ///< true pose of each node
};

Outcome<TrueGraph> pose_graph_from_pyfg(std::string_view text, const std::string& name);

}  // namespace outrider
