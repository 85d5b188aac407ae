#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "graph_log.hpp"
#include "outrider/geometry/spatial_pose.hpp"
#include "outrider/io/g2o.hpp"
#include "outrider/io/track_csv.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/slam/map_error.hpp"
#include "outrider/slam/pose_graph_bound.hpp"
#include "outrider/slam/pose_graph_doubt.hpp"

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

template <class Pose>
std::string edge_name(const PoseGraphOf<Pose>& graph, std::uint32_t edge) {
  return fmt::format("from {} to {}", graph.nodes[graph.edges[edge].from].name,
                     graph.nodes[graph.edges[edge].to].name);
}

/// Returns the least cost if each range is shorter by `bias_m` than it was measured; `graph` has the
/// solution.
double cost_without(PoseGraph graph, double bias_m, const Budget& budget) {
  for (GraphEdge& edge : graph.edges) {
    const double range_m = norm(edge.measured.position);
    if (edge.kind != EdgeKind::pose && range_m > 0.0)
      edge.measured.position = (range_m - bias_m) / range_m * edge.measured.position;
  }
  PoseGraphOptions options;
  options.start = "given";
  const auto solution = optimise(graph, options, budget);
  return solution ? solution->cost : std::numeric_limits<double>::quiet_NaN();
}

/// Returns the root of the mean variance of what was measured to points, and of ranges; 0 if nothing was.
double range_sd_m(const PoseGraph& graph) {
  double sum_m2 = 0.0, count = 0.0;
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind == EdgeKind::pose) continue;
    const Eigen::Matrix2d information = edge.information.topLeftCorner<2, 2>();
    sum_m2 +=
        edge.kind == EdgeKind::range ? 1.0 / edge.information(0, 0) : 0.5 * information.inverse().trace();
    ++count;
  }
  return count == 0.0 ? 0.0 : std::sqrt(sum_m2 / count);
}

/// Returns a constant error of all ranges that makes the measurements much more likely, m: one that is larger
/// than the error of a range, and lowers the cost by more than five standard deviations of chance. 0 if there
/// is none. The cost is about a parabola in it, which three values determine.
double range_bias_m(PoseGraph graph, const PoseGraphSolution& solution, const Budget& budget) {
  constexpr double deviations = 5.0;
  const double step_m = range_sd_m(graph), freedom = degrees_of_freedom(graph);
  if (step_m == 0.0 || freedom <= 1.0) return 0.0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) graph.nodes[i].pose = solution.poses[i];
  const double more = cost_without(graph, step_m, budget), less = cost_without(graph, -step_m, budget);
  const double bend = more + less - 2.0 * solution.cost;
  if (!(bend > 0.0)) return 0.0;
  const double bias_m = 0.5 * step_m * (less - more) / bend;
  const double gain = (more - less) * (more - less) / (8.0 * bend);
  const double scale = std::max(1.0, (solution.cost - gain) / (freedom - 1.0));
  return std::abs(bias_m) > step_m && gain > deviations * deviations * scale ? bias_m : 0.0;
}
/// Space has no points and no ranges.
double range_bias_m(const PoseGraph3& /*graph*/, const PoseGraphSolutionOf<Pose3>& /*solution*/,
                    const Budget& /*budget*/) {
  return 0.0;
}

/// Returns the name of a point of whose edges a third or more is refused; empty if there is none.
template <class Pose>
std::string outvoted_point(const PoseGraphOf<Pose>& graph, const std::vector<std::uint32_t>& refused) {
  std::vector<std::size_t> all(graph.nodes.size(), 0), out(graph.nodes.size(), 0);
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    if (graph.edges[i].kind != EdgeKind::point) continue;
    ++all[graph.edges[i].to];
    out[graph.edges[i].to] += std::ranges::binary_search(refused, i) ? 1 : 0;
  }
  for (std::size_t node = 0; node < all.size(); ++node) {
    if (out[node] > 0 && 3 * out[node] >= all[node]) return graph.nodes[node].name;
  }
  return {};
}

/// Returns why the solution cannot be believed; empty if it can.
template <class Pose>
std::string doubt_sentence(const PoseGraphOf<Pose>& graph, const PoseGraphOf<Pose>& kept,
                           const PoseGraphSolutionOf<Pose>& solution, const Budget& budget) {
  constexpr double largest_share = 0.25;
  const GraphDoubt doubt = doubt_about(kept, solution.poses);
  const auto refused = static_cast<double>(solution.refused.size());
  if (refused > largest_share * (doubt.refusable + refused)) {
    return fmt::format("{} of {} edges that are no odometry are refused; check where they come from", refused,
                       doubt.refusable + refused);
  }
  if (const std::string point = outvoted_point(graph, solution.refused); !point.empty()) {
    return fmt::format(
        "as many edges to point {} are refused as are kept, so it may stand elsewhere; check "
        "whether its sightings are those of another one",
        point);
  }
  if (doubt.edge) {
    return fmt::format(
        "the edge {} contradicts the others: without it the cost would be lower by {:.4g}; "
        "--graph-robust gnc refuses such edges",
        edge_name(kept, *doubt.edge), doubt.edge_cost);
  }
  if (const double bias_m = range_bias_m(kept, solution, budget); bias_m != 0.0) {
    return fmt::format(
        "the measurements are much more likely if all ranges are too {} by {:.2f} m, so the map may be "
        "of a wrong size",
        bias_m > 0.0 ? "long" : "short", std::abs(bias_m));
  }
  if (!doubt.cost) return {};
  return fmt::format(
      "a cost of {:.6g} is implausible for {} degrees of freedom: the information matrices are too large, or "
      "edges contradict each other, which --graph-robust gnc refuses",
      solution.cost, degrees_of_freedom(kept));
}

template <class Pose>
void set_status(Report& report, const PoseGraphOf<Pose>& graph, const PoseGraphOf<Pose>& kept,
                const PoseGraphSolutionOf<Pose>& solution, const Budget& budget) {
  if (!solution.converged) {
    report.status = "not_done";
    report.reason =
        fmt::format("no minimum is reached to the tolerance after {} steps; allow more by --graph-iterations",
                    solution.iterations);
    return;
  }
  report.reason = doubt_sentence(graph, kept, solution, budget);
  if (!report.reason.empty()) report.status = "doubtful";
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
  if (!solution) return tl::unexpected<Fault>(solution.error());
  const PoseGraphOf<Pose> kept = without_edges(input.graph, solution->refused);
  const auto marginals = marginal_covariances(kept, solution->poses);
  run.report.metrics = metrics_of(input, kept, *solution);
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
  set_status(run.report, input.graph, kept, *solution, watch.budget());
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
