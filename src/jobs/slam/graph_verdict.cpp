#include "graph_verdict.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/geometry/spatial_pose.hpp"
#include "outrider/slam/pose_graph_doubt.hpp"

namespace outrider {
namespace {

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
        "a third or more of the edges to point {} are refused, so it may stand elsewhere; check whether its "
        "sightings are those of another one",
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

}  // namespace

template <class Pose>
void judge_graph(Report& report, const PoseGraphOf<Pose>& graph, const PoseGraphOf<Pose>& kept,
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

template void judge_graph(Report&, const PoseGraph&, const PoseGraph&, const PoseGraphSolution&,
                          const Budget&);
template void judge_graph(Report&, const PoseGraph3&, const PoseGraph3&, const PoseGraphSolutionOf<Pose3>&,
                          const Budget&);

}  // namespace outrider
