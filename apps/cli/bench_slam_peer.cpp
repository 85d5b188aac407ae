#include "bench_slam_peer.hpp"

#ifdef OUTRIDER_WITH_CERES

#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <array>
#include <cmath>

#include "clocks.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cli {
namespace {

/// C^T r with the information C C^T, and its derivatives; poses are x, y, heading.
class PoseEdge : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit PoseEdge(const GraphEdge& edge)
      : measured_(edge.measured), root_(transposed(*cholesky(edge.information))) {}

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const double *a = poses[0], *b = poses[1];
    const double c = std::cos(a[2]), s = std::sin(a[2]);
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double x = c * dx + s * dy, y = -s * dx + c * dy;
    const std::array<double, 3> r = {x - measured_.position.x, y - measured_.position.y,
                                     wrap_angle(b[2] - a[2] - measured_.heading_rad)};
    const std::array<double, 3> weighted = root_ * r;
    for (std::size_t i = 0; i < 3; ++i) residuals[i] = weighted[i];
    const Matrix3 by_a = {{-c, -s, y, s, -c, -x, 0.0, 0.0, -1.0}};
    const Matrix3 by_b = {{c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0}};
    for (std::size_t k = 0; jacobians != nullptr && k < 2; ++k) {
      if (jacobians[k] == nullptr) continue;
      const Matrix3 j = root_ * (k == 0 ? by_a : by_b);
      for (std::size_t i = 0; i < 9; ++i) jacobians[k][i] = j.values[i];
    }
    return true;
  }

 private:
  Pose2 measured_;
  Matrix3 root_;
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
  const auto begin = Clock::now();
  ceres::Solve(options, &problem, &summary);
  const double time_s = seconds_since(begin);
  return PeerResult{2.0 * summary.final_cost, time_s, static_cast<int>(summary.iterations.size()) - 1};
}

}  // namespace outrider::cli

#else

namespace outrider::cli {

std::optional<PeerResult> solve_with_ceres(const PoseGraph&) { return std::nullopt; }

}  // namespace outrider::cli

#endif
