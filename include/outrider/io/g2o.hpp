// Pose graphs of the plane as g2o writes them: VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_SE2_XY and FIX, a line
// each, with informations as upper triangles by rows.
//
// Vertices that only edges name get their place from the edges. '#' starts a comment.
// Errors: bad_input with file:line, what is wrong and what would be right. Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/slam/pose_graph.hpp"

namespace outrider {

Outcome<PoseGraph> pose_graph_from_g2o(std::string_view text, const std::string& name);

/// The graph with its nodes at `poses`; reads back to the same numbers. Refuses ranges, which the format does
/// not have, and names that are not whole numbers.
Outcome<std::string> to_g2o(const PoseGraph& graph, const std::vector<Pose2>& poses);

}  // namespace outrider
