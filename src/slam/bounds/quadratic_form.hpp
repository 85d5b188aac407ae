// A sum of quadratic forms of the edges of a pose graph: constant + tr(X Q X^T), with X the columns of the
// rotation and position of each node. SE-Sync (Rosen, Carlone, Bandeira and Leonard, IJRR 38 (2019) 95-125)
// makes the cost of a pose graph such a sum; its dual bounds the least cost, and its relaxation to rotations
// in more dimensions finds it.
//
// X may have any number of rows p not below the dimension: then a "rotation" is a p x D matrix with
// orthonormal columns. The position of the first pose is 0.
#pragma once

#include <utility>

#include "algebra/block_cholesky.hpp"
#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

/// The form of one edge: constant + 2 <cross, R(a)^T R(b)> + spread |t(b) - t(a) - R(a) arm|^2
/// + 2 (R(a) pull)^T (t(b) - t(a)).
template <class Pose>
struct EdgeForm {
  static constexpr int D = dimension<Pose>;
  double constant = 0.0;
  Eigen::Matrix<double, D, D> cross = Eigen::Matrix<double, D, D>::Zero();
  double spread = 0.0;
  Eigen::Matrix<double, D, 1> arm = Eigen::Matrix<double, D, 1>::Zero();
  Eigen::Matrix<double, D, 1> pull = Eigen::Matrix<double, D, 1>::Zero();
};

template <class Pose>
class QuadraticForm {
 public:
  static constexpr int D = dimension<Pose>, B = D + 1;
  using Block = Eigen::Matrix<double, B, B>;
  using Small = Eigen::Matrix<double, D, D>;
  using Columns = Eigen::MatrixXd;  ///< X^T: B rows for each node, one column for each row of X

  /// Begins with the nodes of the graph, which must outlive the form.
  explicit QuadraticForm(const PoseGraphOf<Pose>& graph);
  void add(const GraphEdgeOf<Pose>& edge, const EdgeForm<Pose>& form);
  /// Fixes the position of the first pose at 0; after all edges.
  void fix_first_position();

  [[nodiscard]] double constant() const { return constant_; }
  [[nodiscard]] const BlockMatrix<B>& matrix() const { return matrix_; }
  /// Returns Q X^T.
  [[nodiscard]] Columns times(const Columns& x) const;
  /// Returns the symmetric part of R^T (X Q) for each node, which are the multipliers of R^T R = I where X is
  /// stationary (section 4 of the paper); 0 for points.
  [[nodiscard]] std::vector<Small> multipliers(const Columns& x, const Columns& qx) const;
  /// Returns Q minus the multipliers on the diagonal, with ones where a point has no rotation: the dual
  /// matrix, positive semidefinite where X is a global minimum.
  [[nodiscard]] BlockMatrix<B> minus(const std::vector<Small>& multipliers) const;

 private:
  const PoseGraphOf<Pose>& graph_;
  BlockMatrix<B> matrix_;
  double constant_ = 0.0;
};

/// Returns X^T of these poses, moved so that the first is at 0.
template <class Pose>
Eigen::MatrixXd columns_of(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses);

/// A symmetric matrix of a form whose rotations can be shifted along the diagonal until it is positive
/// definite.
template <class Pose>
class ShiftedMatrix {
 public:
  static constexpr int B = dimension<Pose> + 1;

  ShiftedMatrix(const PoseGraphOf<Pose>& graph, BlockMatrix<B> matrix);
  /// Replaces the matrix by one of the same pairs of nodes.
  void replace(BlockMatrix<B> matrix) { matrix_ = std::move(matrix); }
  /// Factors the matrix with its rotations shifted by so much; false if it is not positive definite.
  bool factor(double shift);
  /// Returns the solution for each column, after a factor() that succeeded.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& columns) const;

 private:
  const PoseGraphOf<Pose>& graph_;
  BlockMatrix<B> matrix_;
  BlockCholesky<B> factor_;
};

}  // namespace outrider
