#include "slam_peer.hpp"

#ifdef OUTRIDER_WITH_CERES

#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "outrider/core/units.hpp"
#include "stopwatch.hpp"

namespace outrider::bench {
namespace {

/// Computes C^T r, where C C^T is the information, and its derivatives; poses are x, y, heading.
class PoseEdge : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit PoseEdge(const GraphEdge& edge)
      : measured_(edge.measured), root_(edge.information.llt().matrixU()) {}

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const double *a = poses[0], *b = poses[1];
    const double c = std::cos(a[2]), s = std::sin(a[2]);
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double x = c * dx + s * dy, y = -s * dx + c * dy;
    const Eigen::Vector3d r(x - measured_.position.x, y - measured_.position.y,
                            wrap_angle(b[2] - a[2] - measured_.heading_rad));
    Eigen::Map<Eigen::Vector3d> weighted(residuals);
    weighted = root_ * r;
    Eigen::Matrix3d by_a, by_b;
    by_a << -c, -s, y, s, -c, -x, 0.0, 0.0, -1.0;
    by_b << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
    using ByRows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    for (std::size_t k = 0; jacobians != nullptr && k < 2; ++k) {
      if (jacobians[k] == nullptr) continue;
      Eigen::Map<ByRows> jacobian(jacobians[k]);
      jacobian = root_ * (k == 0 ? by_a : by_b);
    }
    return true;
  }

 private:
  Pose2 measured_;
  Eigen::Matrix3d root_;
};

Eigen::Matrix3d matrix_of(const Rotation& rotation) {
  Eigen::Matrix3d result;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec3& axis = rotation.axes[static_cast<std::size_t>(k)];
    result.col(k) << axis.x, axis.y, axis.z;
  }
  return result;
}

/// The same in space, as in the example pose_graph_3d of Ceres: positions, and quaternions x y z w.
class SpatialPoseEdge {
 public:
  explicit SpatialPoseEdge(const GraphEdge3& edge)
      : position_(edge.measured.position.x, edge.measured.position.y, edge.measured.position.z),
        rotation_(matrix_of(edge.measured.rotation)),
        root_(edge.information.llt().matrixU()) {}

  template <class T>
  bool operator()(const T* from, const T* from_turn, const T* to, const T* to_turn, T* residuals) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using Turn = Eigen::Quaternion<T>;
    const Eigen::Map<const Vector> a(from), b(to);
    const Eigen::Map<const Turn> qa(from_turn), qb(to_turn);
    const Turn rest = rotation_.template cast<T>().conjugate() * (qa.conjugate() * qb);
    Eigen::Matrix<T, 6, 1> r;
    r.template head<3>() = qa.conjugate() * (b - a) - position_.template cast<T>();
    r.template tail<3>() = (rest.w() < T(0.0) ? T(-2.0) : T(2.0)) * rest.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> weighted(residuals);
    weighted = root_.template cast<T>() * r;
    return true;
  }

 private:
  Eigen::Vector3d position_;
  Eigen::Quaterniond rotation_;
  Eigen::Matrix<double, 6, 6> root_;
};

PeerResult solved(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 1000;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  const Stopwatch watch;
  ceres::Solve(options, &problem, &summary);
  const double time_s = watch.seconds();
  return {2.0 * summary.final_cost, time_s, static_cast<int>(summary.iterations.size()) - 1};
}

}  // namespace

std::optional<PeerResult> solve_with_ceres(const PoseGraph& graph) {
  std::vector<std::array<double, 3>> poses;
  for (const GraphNode& node : graph.nodes) {
    poses.push_back({node.pose.position.x, node.pose.position.y, node.pose.heading_rad});
  }
  ceres::Problem problem;
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) return std::nullopt;
    problem.AddResidualBlock(new PoseEdge(edge), nullptr, poses[edge.from].data(), poses[edge.to].data());
  }
  problem.SetParameterBlockConstant(poses.front().data());
  return solved(problem);
}

std::optional<PeerResult> solve_with_ceres(const PoseGraph3& graph) {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Quaterniond> turns;
  for (const GraphNode3& node : graph.nodes) {
    positions.emplace_back(node.pose.position.x, node.pose.position.y, node.pose.position.z);
    turns.emplace_back(matrix_of(node.pose.rotation));
  }
  ceres::Problem problem;
  for (const GraphEdge3& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) return std::nullopt;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<SpatialPoseEdge, 6, 3, 4, 3, 4>(new SpatialPoseEdge(edge)), nullptr,
        positions[edge.from].data(), turns[edge.from].coeffs().data(), positions[edge.to].data(),
        turns[edge.to].coeffs().data());
  }
  for (Eigen::Quaterniond& turn : turns) {
    if (problem.HasParameterBlock(turn.coeffs().data())) {
      problem.SetManifold(turn.coeffs().data(), new ceres::EigenQuaternionManifold);
    }
  }
  problem.SetParameterBlockConstant(positions.front().data());
  problem.SetParameterBlockConstant(turns.front().coeffs().data());
  return solved(problem);
}

}  // namespace outrider::bench

#else

namespace outrider::bench {

std::optional<PeerResult> solve_with_ceres(const PoseGraph&) { return std::nullopt; }
std::optional<PeerResult> solve_with_ceres(const PoseGraph3&) { return std::nullopt; }

}  // namespace outrider::bench

#endif
