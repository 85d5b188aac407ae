#include "outrider/slam/pose_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph_edges.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

const std::vector<std::string> starts = {"best", "given", "chordal"};
const std::vector<std::string> kernels = {"none", "huber", "cauchy", "geman_mcclure"};

Status check_options(const PoseGraphOptions& options) {
  for (const auto& [names, name, key] :
       {std::tuple(&starts, &options.start, "start"), std::tuple(&kernels, &options.kernel, "kernel")}) {
    if (std::find(names->begin(), names->end(), *name) != names->end()) continue;
    return bad_input(fmt::format("'{}' is not valid; expected {}", *name, fmt::join(*names, ", ")), key);
  }
  return {};
}

std::uint32_t first_pose(const PoseGraph& graph) {
  const auto first = std::find_if(graph.nodes.begin(), graph.nodes.end(),
                                  [](const GraphNode& node) { return !node.is_point; });
  return static_cast<std::uint32_t>(first - graph.nodes.begin());
}

std::vector<Pose2> given_poses(const PoseGraph& graph) {
  std::vector<Pose2> poses;
  for (const GraphNode& node : graph.nodes) poses.push_back(node.pose);
  return poses;
}

double robust_cost(const PoseGraph& graph, const std::vector<Pose2>& poses, const PoseGraphOptions& options) {
  double sum = 0.0;
  for (const GraphEdge& edge : graph.edges) {
    const Eigen::Vector3d r = residual(edge, poses[edge.from], poses[edge.to]);
    const double s = r.dot(edge.information * r);
    sum += robust_loss(options.kernel, options.kernel_width, s).value;
  }
  return sum;
}

void linearise(const PoseGraph& graph, const std::vector<Pose2>& poses, const PoseGraphOptions& options,
               GraphEquations& equations) {
  equations.clear();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    LinearEdge linear = linearise(edge, poses[edge.from], poses[edge.to]);
    const double s = linear.residual.dot(linear.information * linear.residual);
    linear.information *= robust_loss(options.kernel, options.kernel_width, s).weight;
    equations.add(i, linear);
  }
}

/// Returns the headings of the chordal relaxation. It treats rotations as vectors of the plane and minimises
/// the sum of w |z(b) - E z(a)|^2, with the first at its heading.
std::vector<double> chordal_headings(const PoseGraph& graph, std::uint32_t first, GraphEquations& equations) {
  equations.clear(2, 0);
  const Vec2 axis = direction(graph.nodes[first].pose.heading_rad);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    if (edge.kind != EdgeKind::pose) continue;
    LinearEdge linear;
    const Vec2 turn = direction(edge.measured.heading_rad);
    linear.by_from.topLeftCorner<2, 2>() << -turn.x, turn.y, -turn.y, -turn.x;
    linear.by_to.diagonal() << 1.0, 1.0, 0.0;
    linear.information.diagonal() << edge.information(2, 2), edge.information(2, 2), 0.0;
    if (edge.from == first) linear.residual = linear.by_from * Eigen::Vector3d(axis.x, axis.y, 0.0);
    if (edge.to == first) linear.residual = linear.by_to * Eigen::Vector3d(axis.x, axis.y, 0.0);
    equations.add(i, linear);
  }
  std::vector<double> headings;
  for (const Eigen::Vector3d& z : equations.solve(0.0)) headings.push_back(std::atan2(z[1], z[0]));
  if (!headings.empty()) headings[first] = graph.nodes[first].pose.heading_rad;
  return headings;
}

/// Returns the positions for given headings: one linear step from any initial positions.
std::vector<Pose2> chordal_positions(const PoseGraph& graph, const std::vector<double>& headings,
                                     GraphEquations& equations) {
  std::vector<Pose2> poses = given_poses(graph);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].heading_rad = headings[i];
  equations.clear(2, 2);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    if (edge.kind == EdgeKind::range) continue;
    LinearEdge linear = linearise(edge, poses[edge.from], poses[edge.to]);
    linear.by_from.col(2).setZero();
    linear.by_to.col(2).setZero();
    linear.information.col(2).setZero();
    linear.information.row(2).setZero();
    equations.add(i, linear);
  }
  const std::vector<Eigen::Vector3d> steps = equations.solve(0.0);
  if (steps.empty()) return {};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = graph.nodes[i].is_point ? Pose2{retract(poses[i], steps[i]).position, 0.0}
                                       : retract(poses[i], {steps[i][0], steps[i][1], 0.0});
  }
  return poses;
}

Outcome<std::vector<Pose2>> chordal(const PoseGraph& graph, GraphEquations& equations) {
  const std::vector<double> headings = chordal_headings(graph, first_pose(graph), equations);
  std::vector<Pose2> poses;
  if (!headings.empty()) poses = chordal_positions(graph, headings, equations);
  if (!poses.empty()) return poses;
  return bad_input("relative poses alone do not join all poses; take the start given", "start");
}

struct Start {
  std::vector<Pose2> poses;
  std::string name;
};
Outcome<Start> choose_start(const PoseGraph& graph, const PoseGraphOptions& options,
                            GraphEquations& equations) {
  Start given{given_poses(graph), "given"};
  if (options.start == "given") return given;
  auto relaxed = chordal(graph, equations);
  if (!relaxed && options.start == "chordal") return pass_on(relaxed);
  const bool take = relaxed && (options.start == "chordal" || robust_cost(graph, *relaxed, options) <
                                                                  robust_cost(graph, given.poses, options));
  return take ? Start{std::move(*relaxed), "chordal"} : given;
}

std::vector<Pose2> retract_all(const PoseGraph& graph, const std::vector<Pose2>& poses,
                               const std::vector<Eigen::Vector3d>& step) {
  std::vector<Pose2> result = poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    result[i] = retract(poses[i], step[i]);
    if (graph.nodes[i].is_point) result[i].heading_rad = 0.0;
  }
  return result;
}

/// The damping is equal for all unknowns (Levenberg). If it were proportional to the diagonal (Marquardt), a
/// stiff edge between two poses would prevent both from moving.
constexpr double least_damping = 1e-3;
constexpr double most_damping = 1e12;

}  // namespace

std::vector<Option> describe(PoseGraphOptions& options) {
  return {
      {"start", "", 0, 0,
       "where to begin: given (by the file), chordal (a relaxation), or the better of both: best",
       &options.start},
      {"kernel", "", 0, 0, "loss of an edge that does not fit: none, huber, cauchy or geman_mcclure",
       &options.kernel},
      {"kernel_width", "", 1e-3, 1e6, "standard deviations from which a kernel weighs down",
       &options.kernel_width},
      {"iterations", "", 1, 100'000, "most steps of the optimisation", &options.iterations},
      {"tolerance", "", 1e-15, 1.0, "relative decrease of the cost at which to stop", &options.tolerance}};
}

double cost(const PoseGraph& graph, const std::vector<Pose2>& poses) { return robust_cost(graph, poses, {}); }

Outcome<PoseGraphSolution> optimise(const PoseGraph& graph, const PoseGraphOptions& options,
                                    const Budget& budget) {
  if (auto ok = check_options(options); !ok) return pass_on(ok);
  if (auto ok = check(graph); !ok) return pass_on(ok);
  BudgetMeter meter(budget);
  GraphEquations equations(graph, first_pose(graph));
  auto start = choose_start(graph, options, equations);
  if (!start) return pass_on(start);
  PoseGraphSolution best{std::move(start->poses), 0, 0, 0, 0, start->name, false};
  best.start_cost = cost(graph, best.poses);
  best.robust_cost = robust_cost(graph, best.poses, options);
  double damping = 0.0;
  while (best.iterations < options.iterations && damping < most_damping && !best.converged) {
    if (!meter.spend()) {
      if (best.iterations == 0) return meter.refusal();
      break;
    }
    ++best.iterations;
    linearise(graph, best.poses, options, equations);
    const std::vector<Eigen::Vector3d> step = equations.solve(damping);
    const double predicted = step.empty() ? 0.0 : equations.predicted_decrease(step);
    std::vector<Pose2> next = step.empty() ? best.poses : retract_all(graph, best.poses, step);
    const double next_cost = step.empty() ? best.robust_cost : robust_cost(graph, next, options);
    const double decrease = best.robust_cost - next_cost;
    best.converged = !step.empty() && predicted <= options.tolerance * best.robust_cost;
    if (decrease > 0.0) {
      damping = damping > least_damping ? 0.1 * damping : 0.0;
      best.poses = std::move(next);
      best.robust_cost = next_cost;
    } else {
      damping = std::max(least_damping, 10.0 * damping);
    }
  }
  best.cost = cost(graph, best.poses);
  return best;
}

Outcome<std::vector<Eigen::Matrix3d>> marginal_covariances(const PoseGraph& graph,
                                                           const std::vector<Pose2>& poses) {
  if (auto ok = check(graph); !ok) return pass_on(ok);
  if (poses.size() != graph.nodes.size()) {
    return bad_input(
        fmt::format("{} poses for {} nodes; give one for each", poses.size(), graph.nodes.size()));
  }
  const std::uint32_t first = first_pose(graph);
  GraphEquations equations(graph, first);
  linearise(graph, poses, {}, equations);
  std::vector<Eigen::Matrix3d> result = equations.covariances();
  if (result.empty()) return bad_input("the measurements do not determine every node; add some");
  result[first].setZero();
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (graph.nodes[i].is_point) result[i](2, 2) = 0.0;
  }
  return result;
}

}  // namespace outrider
