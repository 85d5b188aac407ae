// Planar pose graphs in the g2o format: lines VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_SE2_XY and FIX, with
// information matrices as upper triangles by rows.
//
// Vertices that occur only in edges are placed by the edges. Only the first vertex may be fixed. '#' starts a
// comment. Faults: bad_input with file:line, the error and the remedy. Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/slam/pose_graph.hpp"

namespace outrider {

Outcome<PoseGraph> pose_graph_from_g2o(std::string_view text, const std::string& name);

/// Returns the graph with its nodes at `poses` as g2o text, which reads back to the same numbers. Faults:
/// bad_input for ranges, which the format does not have, and for names that are not integers.
Outcome<std::string> to_g2o(const PoseGraph& graph, const std::vector<Pose2>& poses);

}  // namespace outrider
