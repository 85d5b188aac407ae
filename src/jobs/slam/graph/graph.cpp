#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "graph/graph_log.hpp"
#include "graph/graph_verdict.hpp"
#include "outrider/geometry/spatial_pose.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/io/log/trajectory.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"
#include "outrider/slam/map_error.hpp"

namespace outrider {
namespace {

Pose2 plan_of(const Pose2& pose) { return pose; }
Pose2 plan_of(const Pose3& pose) { return plan_pose(pose); }

Eigen::Matrix3d plan_of(const Eigen::Matrix3d& covariance) { return covariance; }
/// The heading of a level robot turns as the rotation about the vertical.
Eigen::Matrix3d plan_of(const PoseMatrix<Pose3>& covariance) {
  constexpr std::array<Eigen::Index, 3> kept = {0, 1, 5};
  return covariance(kept, kept);
}

template <class T>
auto plan_of(const std::vector<T>& values) {
  std::vector<decltype(plan_of(values.front()))> result;
  for (const T& value : values) result.push_back(plan_of(value));
  return result;
}

template <class Pose>
PoseGraph plan_of(const PoseGraphOf<Pose>& graph) {
  PoseGraph result;
  for (const auto& node : graph.nodes) result.nodes.push_back({node.name, {}, node.is_point});
  for (const auto& edge : graph.edges) result.edges.push_back({edge.kind, edge.from, edge.to, {}});
  return result;
}

/// Returns the poses that odometry alone gives along each path, by node.
template <class Pose>
std::vector<Pose> odometry_of(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  std::vector<Pose> result = poses;
  const Ways ways(graph);
  for (const std::vector<NodeIndex>& way : ways.all()) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      const auto& edge = graph.edges[ways.edge(way[i - 1], way[i])];
      const Pose motion = edge.from == way[i - 1] ? edge.measured : inverse(edge.measured);
      result[way[i]] = compose(result[way[i - 1]], motion);
    }
  }
  return result;
}

/// Estimated positions of the points, or of the poses, and their true positions.
struct Compared {
  std::vector<Vec2> estimate;
  std::vector<Vec2> truth;
};

template <class Pose>
Compared compared(const GraphInput<Pose>& input, const std::vector<Pose>& poses, bool points) {
  Compared places;
  for (std::size_t i = 0; i < input.truth.size(); ++i) {
    if (input.graph.nodes[i].is_point != points) continue;
    places.estimate.push_back(plan_of(poses[i]).position);
    places.truth.push_back(plan_of(input.truth[i]).position);
  }
  return places;
}

/// Returns the root mean square error of the landmarks or of the poses.
template <class Pose>
std::optional<double> rms_error(const GraphInput<Pose>& input, const std::vector<Pose>& poses, bool points,
                                bool aligned) {
  const auto [estimate, truth] = compared(input, poses, points);
  return rms_distance(estimate, truth, aligned ? rigid_alignment(estimate, truth) : Pose2{});
}

/// Returns the true positions in the frame of the map.
template <class Pose>
std::vector<Vec2> truth_on_map(const GraphInput<Pose>& input, const std::vector<Pose>& poses) {
  const auto [estimate, truth] = compared(input, poses, false);
  std::vector<Vec2> result;
  if (truth.empty()) return result;
  const Pose2 map_T_truth = rigid_alignment(truth, estimate);
  for (const Pose& pose : input.truth) result.push_back(map_T_truth * plan_of(pose).position);
  return result;
}

constexpr double no_bound = std::numeric_limits<double>::quiet_NaN();

template <class Pose>
Metrics metrics_of(const GraphInput<Pose>& input, const PoseGraphOf<Pose>& kept,
                   const PoseGraphSolutionOf<Pose>& solution) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  const auto bound = least_cost_bound(kept, solution.poses);
  return {{"landmark_rmse_m", known(rms_error(input, solution.poses, true, false))},
          {"landmark_rmse_aligned_m", known(rms_error(input, solution.poses, true, true))},
          {"ate_m", known(rms_error(input, solution.poses, false, true))},
          {"cost", solution.cost},
          {"cost_bound", bound ? *bound : no_bound},
          {"degrees_of_freedom", degrees_of_freedom(kept)},
          {"steps", number(solution.iterations)},
          {"nodes", number(input.graph.nodes.size())},
          {"edges", number(input.graph.edges.size())},
          {"edges_refused", number(solution.refused.size())},
          {"start_cost", solution.start_cost},
          {"robust_cost", solution.robust_cost},
          {"descents", number(solution.descents)},
          {"descents_agreeing", number(solution.descents_agreeing)}};
}

/// Returns the refused edges as a table; they are in the log as events too.
template <class Pose>
Table refused_edges(const PoseGraphOf<Pose>& graph, const PoseGraphSolutionOf<Pose>& solution) {
  Table table{"refused_edges", {"edge", "from", "to"}, {}};
  for (const std::uint32_t i : solution.refused) {
    const auto& edge = graph.edges[i];
    table.rows.push_back({static_cast<double>(i), graph.nodes[edge.from].name, graph.nodes[edge.to].name});
  }
  return table;
}

}  // namespace

template <class Pose>
Status solve_graph(const SlamJob& job, const GraphInput<Pose>& input, Run& run, const RunWatch& watch) {
  const SlamScenario& scenario = job.scenario;
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("optimising"); !ok) return ok;
  const double began_s = wall_s();
  const auto solution = optimise(input.graph, scenario.graph, watch.budget());
  const double time_s = wall_s() - began_s;
  if (!solution) return pass_on(solution);
  const auto cancelled = [] {
    return fault(FaultCode::cancelled, "it was cancelled before the graph was solved and judged");
  };
  if (watch.stopped()) return cancelled();
  const PoseGraphOf<Pose> kept = without_edges(input.graph, solution->refused);
  const auto marginals = marginal_covariances(kept, solution->poses);
  if (watch.stopped()) return cancelled();
  Metrics metrics = metrics_of(input, kept, *solution);
  if (watch.stopped()) return cancelled();
  run.report.metrics = std::move(metrics);
  PlanGraph plan = {plan_of(kept),
                    plan_of(solution->poses),
                    plan_of(odometry_of(input.graph, solution->poses)),
                    marginals ? plan_of(*marginals) : std::vector<Eigen::Matrix3d>(),
                    truth_on_map(input, solution->poses),
                    solution->start,
                    {}};
  for (const std::uint32_t edge : solution->refused) plan.refused.push_back(edge_name(input.graph, edge));
  const Metrics logged = log_graph(run.log, scenario, plan);
  run.report.metrics.insert(run.report.metrics.end(), logged.begin(), logged.end());
  judge_graph(run.report, input.graph, kept, *solution);
  if (!solution->refused.empty()) run.report.tables.push_back(refused_edges(input.graph, *solution));
  run.report.machine_times = {
      {"time_s", time_s},
      {"max_step_s", time_s / static_cast<double>(std::max<std::int64_t>(1, solution->iterations))}};
  run.files = {{"track.csv", track_csv(plan.poses)}};
  if (auto g2o = to_g2o(kept, solution->poses)) run.files.push_back({"graph.g2o", *g2o});
  return {};
}

template Status solve_graph(const SlamJob&, const GraphInput<Pose2>&, Run&, const RunWatch&);
template Status solve_graph(const SlamJob&, const GraphInput<Pose3>&, Run&, const RunWatch&);

}  // namespace outrider
