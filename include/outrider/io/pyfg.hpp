// Graphs of several robots in the PyFG format: VERTEX_SE2 and VERTEX_XY give the truth, EDGE_SE2 (odometry),
// EDGE_SE2_XY and EDGE_RANGE the measurements with their covariances as upper triangles. Poses are named by
// a letter for the robot and a number.
//
// The first pose of each robot is taken from the truth, as where it was put; all others start where the edges
// say. Errors: bad_input with file:line, what is wrong and what would be right. Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/slam/pose_graph.hpp"

namespace outrider {

struct TrueGraph {
  PoseGraph graph;
  std::vector<Pose2> truth;  ///< by node
};

Outcome<TrueGraph> pose_graph_from_pyfg(std::string_view text, const std::string& name);

}  // namespace outrider
