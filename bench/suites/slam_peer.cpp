#include "slam_peer.hpp"

#ifdef OUTRIDER_WITH_CERES

#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
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
    Eigen::Map<Eigen::Vector3d>(residuals) = root_ * r;
    Eigen::Matrix3d by_a, by_b;
    by_a << -c, -s, y, s, -c, -x, 0.0, 0.0, -1.0;
    by_b << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
    using ByRows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    for (std::size_t k = 0; jacobians != nullptr && k < 2; ++k) {
      if (jacobians[k] != nullptr) Eigen::Map<ByRows>(jacobians[k]) = root_ * (k == 0 ? by_a : by_b);
    }
    return true;
  }

 private:
  Pose2 measured_;
  Eigen::Matrix3d root_;
};

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
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 1000;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  const Stopwatch watch;
  ceres::Solve(options, &problem, &summary);
  const double time_s = watch.seconds();
  return PeerResult{2.0 * summary.final_cost, time_s, static_cast<int>(summary.iterations.size()) - 1};
}

}  // namespace outrider::bench

#else

namespace outrider::bench {

std::optional<PeerResult> solve_with_ceres(const PoseGraph&) { return std::nullopt; }

}  // namespace outrider::bench

#endif
