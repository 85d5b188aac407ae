// Pose graphs in the formats g2o and TORO.
//
// In the plane: lines VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_SE2_XY and FIX, with information matrices as
// upper triangles by rows; and VERTEX2 and EDGE2 of TORO, whose information is xx xy yy hh xh yh. In space:
// lines VERTEX_SE3:QUAT (position, quaternion x y z w), EDGE_SE3:QUAT and FIX. A file is of one kind.
//
// Vertices that occur only in edges are placed by the edges. Only the first vertex may be fixed. '#' starts a
// comment. Faults: bad_input with file:line, the error and the remedy. Bounds: 2,000,000 lines.
#pragma once

#include <string>
#include <string_view>

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

/// The terms of the information matrices that are read. `diagonal` is for files whose other terms are wrong.
/// `isotropic` gives one number to positions and one to rotations, the inverse of the mean variance of each
/// (Rosen et al., IJRR 38 (2019), the objective of SE-Sync).
enum class InformationTerms { all, diagonal, isotropic };

Outcome<PoseGraph> pose_graph_from_g2o(std::string_view text, const std::string& name,
                                       InformationTerms terms = InformationTerms::all);
Outcome<PoseGraph3> pose_graph3_from_g2o(std::string_view text, const std::string& name,
                                         InformationTerms terms = InformationTerms::all);

/// Returns true if the first line that is no comment is of a graph in space.
bool is_spatial_g2o(std::string_view text);

/// Returns the graph with its nodes at `poses` as g2o text, which reads back to the same numbers; rotations
/// in space to rounding. Faults: bad_input for what the format does not have (ranges; in space, points), and
/// for names that are not integers.
Outcome<std::string> to_g2o(const PoseGraph& graph, const std::vector<Pose2>& poses);
Outcome<std::string> to_g2o(const PoseGraph3& graph, const std::vector<Pose3>& poses);

}  // namespace outrider
