// The edges of a pose graph: residuals, Jacobians and robust weights.
//
// Unknowns are steps (position, rotation) along the world's axes. retract() moves a pose by a step along a
// screw that leaves in the direction of the position and turns by the rotation, so poses that rotate together
// about one point keep their relative poses exactly, however stiff the edges between them. A residual of
// fewer numbers than a pose has unknowns is padded with zeros, and so is its information.
#pragma once

#include <string_view>

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

template <class Pose>
using PoseVector = Eigen::Matrix<double, freedoms<Pose>, 1>;

/// Numbers of the residual of an edge.
template <class Pose>
constexpr int residual_rows(EdgeKind kind) {
  return kind == EdgeKind::pose ? freedoms<Pose> : kind == EdgeKind::point ? dimension<Pose> : 1;
}

template <class Pose>
struct LinearEdgeOf {
  PoseVector<Pose> residual = PoseVector<Pose>::Zero();
  PoseMatrix<Pose> by_from = PoseMatrix<Pose>::Zero();  ///< derivative of the residual by a step of `from`
  PoseMatrix<Pose> by_to = PoseMatrix<Pose>::Zero();
  PoseMatrix<Pose> information = PoseMatrix<Pose>::Zero();
};
using LinearEdge = LinearEdgeOf<Pose2>;

Eigen::Vector3d residual(const GraphEdge& edge, const Pose2& from, const Pose2& to);
PoseVector<Pose3> residual(const GraphEdge3& edge, const Pose3& from, const Pose3& to);
LinearEdge linearise(const GraphEdge& edge, const Pose2& from, const Pose2& to);
LinearEdgeOf<Pose3> linearise(const GraphEdge3& edge, const Pose3& from, const Pose3& to);

Pose2 retract(const Pose2& pose, const Eigen::Vector3d& step);
Pose3 retract(const Pose3& pose, const PoseVector<Pose3>& step);

/// The parts of a pose as matrices, for code that serves the plane and space.
Eigen::Vector2d position_of(const Pose2& pose);
Eigen::Vector3d position_of(const Pose3& pose);
Eigen::Matrix2d rotation_of(const Pose2& pose);
Eigen::Matrix3d rotation_of(const Pose3& pose);
/// Sets the rotation to the one nearest to the matrix.
void set_rotation(Pose2& pose, const Eigen::Matrix2d& matrix);
void set_rotation(Pose3& pose, const Eigen::Matrix3d& matrix);
void set_position(Pose2& pose, const Eigen::Vector2d& position);
void set_position(Pose3& pose, const Eigen::Vector3d& position);

/// The information of the rotation as one number: the inverse of its mean variance.
template <class Pose>
double rotation_weight(const GraphEdgeOf<Pose>& edge);

/// The loss of a robust kernel at s = r^T W r, and its derivative by s: the weight of the edge.
struct Loss {
  double value = 0.0;
  double weight = 1.0;
};
Loss robust_loss(std::string_view kernel, double width, double s);

}  // namespace outrider
