#include "bounds/quadratic_form.hpp"

#include <utility>

#include "graph/graph_edges.hpp"
#include "graph/graph_starts.hpp"

namespace outrider {

template <class Pose>
QuadraticForm<Pose>::QuadraticForm(const PoseGraphOf<Pose>& graph) : graph_(graph) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) matrix_.add_node();
}

template <class Pose>
void QuadraticForm<Pose>::add(const GraphEdgeOf<Pose>& edge, const EdgeForm<Pose>& form) {
  constant_ += form.constant;
  Block from = Block::Zero(), to = Block::Zero(), mixed = Block::Zero();  // rows of `from`
  const double spread = form.spread;
  from.template topLeftCorner<D, D>() = spread * form.arm * form.arm.transpose();
  from.template topRightCorner<D, 1>() = spread * form.arm - form.pull;
  from.template bottomLeftCorner<1, D>() = from.template topRightCorner<D, 1>().transpose();
  from(D, D) = to(D, D) = spread;
  mixed.template topLeftCorner<D, D>() = form.cross;
  mixed.template topRightCorner<D, 1>() = form.pull - spread * form.arm;
  mixed(D, D) = -spread;
  matrix_.diagonal(edge.from) += from;
  matrix_.diagonal(edge.to) += to;
  const std::uint32_t pair = matrix_.pair(edge.from, edge.to);
  if (edge.from < edge.to) {
    matrix_.upper_block(pair) += mixed;
  } else {
    matrix_.upper_block(pair) += mixed.transpose();
  }
}

template <class Pose>
void QuadraticForm<Pose>::fix_first_position() {
  const std::uint32_t first = first_pose(graph_);
  matrix_.diagonal(first).row(D).setZero();
  matrix_.diagonal(first).col(D).setZero();
  matrix_.diagonal(first)(D, D) = 1.0;
  for (const auto& neighbour : matrix_.neighbours(first)) {
    if (first < neighbour.node) {
      matrix_.upper_block(neighbour.pair).row(D).setZero();
    } else {
      matrix_.upper_block(neighbour.pair).col(D).setZero();
    }
  }
}

template <class Pose>
typename QuadraticForm<Pose>::Columns QuadraticForm<Pose>::times(const Columns& x) const {
  Columns result(x.rows(), x.cols());
  for (std::uint32_t i = 0; i < matrix_.size(); ++i) {
    auto rows = result.template middleRows<B>(B * i);
    rows.noalias() = matrix_.diagonal(i) * x.template middleRows<B>(B * i);
    for (const auto& neighbour : matrix_.neighbours(i)) {
      rows.noalias() += matrix_.block(i, neighbour) * x.template middleRows<B>(B * neighbour.node);
    }
  }
  return result;
}

template <class Pose>
std::vector<typename QuadraticForm<Pose>::Small> QuadraticForm<Pose>::multipliers(const Columns& x,
                                                                                  const Columns& qx) const {
  std::vector<Small> result(matrix_.size(), Small::Zero());
  for (std::uint32_t i = 0; i < matrix_.size(); ++i) {
    if (graph_.nodes[i].is_point) continue;
    const Small m = x.template middleRows<D>(B * i) * qx.template middleRows<D>(B * i).transpose();
    result[i] = 0.5 * (m + m.transpose());
  }
  return result;
}

template <class Pose>
BlockMatrix<QuadraticForm<Pose>::B> QuadraticForm<Pose>::minus(const std::vector<Small>& multipliers) const {
  BlockMatrix<B> result = matrix_;
  for (std::uint32_t i = 0; i < result.size(); ++i) {
    if (graph_.nodes[i].is_point) {
      result.diagonal(i).diagonal().template head<D>().setOnes();
    } else {
      result.diagonal(i).template topLeftCorner<D, D>() -= multipliers[i];
    }
  }
  return result;
}

template <class Pose>
Eigen::MatrixXd columns_of(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  constexpr int D = dimension<Pose>, B = D + 1;
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(B * static_cast<Eigen::Index>(poses.size()), D);
  const auto origin = position_of(poses[first_pose(graph)]);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto rows = x.template middleRows<B>(B * static_cast<Eigen::Index>(i));
    if (!graph.nodes[i].is_point) rows.template topRows<D>() = rotation_of(poses[i]).transpose();
    rows.row(D) = (position_of(poses[i]) - origin).transpose();
  }
  return x;
}

template <class Pose>
ShiftedMatrix<Pose>::ShiftedMatrix(const PoseGraphOf<Pose>& graph, BlockMatrix<B> matrix)
    : graph_(graph), matrix_(std::move(matrix)) {
  factor_.begin(least_fill_order(matrix_));
  factor_.analyse_all(matrix_);
}

template <class Pose>
bool ShiftedMatrix<Pose>::factor(double shift) {
  BlockMatrix<B> shifted = matrix_;
  for (std::uint32_t node = 0; node < shifted.size(); ++node) {
    if (!graph_.nodes[node].is_point)
      shifted.diagonal(node).diagonal().template head<B - 1>().array() += shift;
  }
  return factor_.factor_all(shifted);
}

template <class Pose>
Eigen::MatrixXd ShiftedMatrix<Pose>::solve(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  std::vector<Eigen::Matrix<double, B, 1>> right(matrix_.size());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    for (std::size_t i = 0; i < right.size(); ++i) {
      right[i] = columns.col(k).template segment<B>(B * static_cast<Eigen::Index>(i));
    }
    const auto solved = factor_.solve(right);
    for (std::size_t i = 0; i < right.size(); ++i) {
      result.col(k).template segment<B>(B * static_cast<Eigen::Index>(i)) = solved[i];
    }
  }
  return result;
}

template class QuadraticForm<Pose2>;
template class QuadraticForm<Pose3>;
template Eigen::MatrixXd columns_of(const PoseGraph&, const std::vector<Pose2>&);
template Eigen::MatrixXd columns_of(const PoseGraph3&, const std::vector<Pose3>&);
template class ShiftedMatrix<Pose2>;
template class ShiftedMatrix<Pose3>;

}  // namespace outrider
