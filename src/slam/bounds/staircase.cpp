#include "bounds/staircase.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bounds/stiefel_descent.hpp"
#include "graph/graph_edges.hpp"
#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

/// The cost of an edge with one weight for its position and one for its rotation.
template <class Pose>
EdgeForm<Pose> simple_form(const GraphEdgeOf<Pose>& edge) {
  constexpr int D = dimension<Pose>;
  EdgeForm<Pose> form;
  form.spread = D / edge.information.template topLeftCorner<D, D>().inverse().trace();
  form.arm = position_of(edge.measured);
  if (edge.kind == EdgeKind::point) return form;
  const double weight = rotation_weight(edge);
  form.constant = weight * D;
  form.cross = -0.5 * weight * rotation_of(edge.measured);
  return form;
}

template <class Pose>
class Staircase {
 public:
  static constexpr int D = dimension<Pose>, B = D + 1;

  explicit Staircase(const PoseGraphOf<Pose>& graph) : graph_(graph), descent_(graph, form_of(graph)) {}

  StaircaseResult<Pose> climb(const std::vector<Pose>& poses, std::int64_t iterations, BudgetMeter& meter) {
    constexpr double roughly = 1e-4, exactly = 1e-12;  // relative changes of the cost
    StaircaseResult<Pose> result;
    Eigen::MatrixXd x = columns_of(graph_, poses);
    std::int64_t left = iterations;
    while (descent_.descend(x, roughly, left, meter)) {
      if (leaves(x, roughly)) continue;
      if (!descent_.descend(x, exactly, left, meter)) break;
      result.proven = is_least(x);
      if (result.proven || !leaves(x, exactly)) break;
    }
    result.rank = static_cast<int>(x.cols());
    result.iterations = iterations - left;
    result.poses = rounded(x, poses);
    return result;
  }

 private:
  static QuadraticForm<Pose> form_of(const PoseGraphOf<Pose>& graph) {
    QuadraticForm<Pose> form(graph);
    for (const auto& edge : graph.edges) form.add(edge, simple_form(edge));
    form.fix_first_position();
    return form;
  }

  [[nodiscard]] ShiftedMatrix<Pose> dual_at(const Eigen::MatrixXd& x) const {
    const auto multipliers = descent_.form().multipliers(x, descent_.form().times(x));
    return {graph_, descent_.form().minus(multipliers)};
  }
  /// The shift of the dual matrix that loses that part of the cost.
  [[nodiscard]] double shift_for(double loss, const Eigen::MatrixXd& x) const {
    return loss * std::max(descent_.cost(x), 1e-3) / static_cast<double>(D * graph_.nodes.size());
  }
  /// The dual matrix is positive semidefinite, up to a loss of 1e-4 of the cost.
  [[nodiscard]] bool is_least(const Eigen::MatrixXd& x) const {
    return dual_at(x).factor(shift_for(least_loss, x));
  }

  /// Returns a direction of negative curvature of the dual matrix, by inverse iteration with a shift just
  /// above its least eigenvalue; empty if none is found.
  [[nodiscard]] std::optional<Eigen::VectorXd> way_down(const Eigen::MatrixXd& x) const {
    constexpr double most = 1e6;
    ShiftedMatrix<Pose> dual = dual_at(x);
    const double whole = shift_for(1.0, x);
    double loss = least_loss;
    while (loss < most && !dual.factor(loss * whole)) loss *= 2.0;
    if (loss == least_loss || loss >= most) return std::nullopt;
    return least_eigenvector(dual, loss * whole);
  }

  [[nodiscard]] std::optional<Eigen::VectorXd> least_eigenvector(const ShiftedMatrix<Pose>& shifted,
                                                                 double shift) const {
    constexpr int rounds = 30;
    Rng rng(1);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(B * static_cast<Eigen::Index>(graph_.nodes.size()));
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = rng.uniform(-1.0, 1.0);
    for (int round = 0; round < rounds; ++round) {
      const Eigen::VectorXd rotations = only_rotations(v);
      v = shifted.solve(rotations / rotations.norm());
      // v^T M v = v^T (M + shift E) v - shift v^T E v, with E the identity of the rotations
      const double curvature = v.dot(rotations) / rotations.norm() - shift * only_rotations(v).squaredNorm();
      if (curvature < -0.25 * shift * only_rotations(v).squaredNorm()) return v / only_rotations(v).norm();
    }
    return std::nullopt;
  }

  [[nodiscard]] Eigen::VectorXd only_rotations(Eigen::VectorXd v) const {
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
      auto block = v.template segment<B>(B * static_cast<Eigen::Index>(i));
      block[D] = 0.0;
      if (graph_.nodes[i].is_point) block.setZero();
    }
    return v;
  }

  /// Goes down along a direction of negative curvature in a dimension of its own; false if there is none
  /// that lowers the cost by this part of it.
  [[nodiscard]] bool leaves(Eigen::MatrixXd& x, double part) const {
    constexpr Eigen::Index most_more = 5;  // dimensions
    if (x.cols() == D + most_more) return false;
    const std::optional<Eigen::VectorXd> direction = way_down(x);
    if (!direction) return false;
    const double before = descent_.cost(x), below = before - part * std::max(before, 1e-3);
    const double most = std::sqrt(static_cast<double>(graph_.nodes.size()));
    for (double length = most; length > 1e-6 * most; length *= 0.5) {
      Eigen::MatrixXd next(x.rows(), x.cols() + 1);
      next << x, length * *direction;
      descent_.retract(next);
      if (descent_.cost(next) >= below) continue;
      x = std::move(next);
      return true;
    }
    return false;
  }

  /// Returns the nearest poses: the D main directions of all rotations, then the nearest rotation of each.
  [[nodiscard]] std::vector<Pose> rounded(const Eigen::MatrixXd& x, const std::vector<Pose>& poses) const {
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(x.cols(), x.cols());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto rotation = x.template middleRows<D>(B * static_cast<Eigen::Index>(i));
      if (!graph_.nodes[i].is_point) spread += rotation.transpose() * rotation;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(spread);
    Eigen::MatrixXd plane = eigen.eigenvectors().rightCols(D);
    double handedness = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!graph_.nodes[i].is_point) handedness += std::copysign(1.0, rotation_in(x, i, plane).determinant());
    }
    if (handedness < 0.0) plane.col(0) *= -1.0;

    const std::uint32_t first = first_pose(graph_);
    std::vector<Pose> result = poses;
    set_rotation(result[first], rotation_in(x, first, plane));
    const Eigen::Matrix<double, D, D> turn =
        rotation_of(poses[first]) * rotation_of(result[first]).transpose();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Eigen::Index row = B * static_cast<Eigen::Index>(i) + D;
      set_position(result[i], position_of(poses[first]) + turn * (x.row(row) * plane).transpose());
      if (!graph_.nodes[i].is_point) set_rotation(result[i], turn * rotation_in(x, i, plane));
    }
    result[first] = poses[first];
    return result;
  }
  [[nodiscard]] static Eigen::Matrix<double, D, D> rotation_in(const Eigen::MatrixXd& x, std::size_t node,
                                                               const Eigen::MatrixXd& plane) {
    return (x.template middleRows<D>(B * static_cast<Eigen::Index>(node)) * plane).transpose();
  }

  static constexpr double least_loss = 1e-4;  ///< of the cost; less is not told from rounding
  const PoseGraphOf<Pose>& graph_;
  StiefelDescent<Pose> descent_;
};

}  // namespace

template <class Pose>
StaircaseResult<Pose> climb_staircase(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
                                      std::int64_t iterations, BudgetMeter& meter) {
  return Staircase<Pose>(graph).climb(poses, iterations, meter);
}

template StaircaseResult<Pose2> climb_staircase(const PoseGraph&, const std::vector<Pose2>&, std::int64_t,
                                                BudgetMeter&);
template StaircaseResult<Pose3> climb_staircase(const PoseGraph3&, const std::vector<Pose3>&, std::int64_t,
                                                BudgetMeter&);

}  // namespace outrider
