#include "graph/graph_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/geometry/spatial_pose.hpp"
#include "outrider/slam/graph/pose_graph_doubt.hpp"
#include "outrider/slam/graph/systematic_errors.hpp"

namespace outrider {
namespace {

std::string size_doubt(const PoseGraph& graph, const PoseGraphSolution& solution) {
  return why_not_believed(find_systematic_errors(graph, solution.poses));
}
/// Graphs of space have neither points nor ranges, which would tell their size a second time.
std::string size_doubt(const PoseGraph3& /*graph*/, const PoseGraphSolutionOf<Pose3>& /*solution*/) {
  return {};
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
                           const PoseGraphSolutionOf<Pose>& solution) {
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
  if (doubt.cost) {
    return fmt::format(
        "a cost of {:.6g} is implausible for {} degrees of freedom: the information matrices are too large, "
        "or "
        "edges contradict each other, which --graph-robust gnc refuses",
        solution.cost, degrees_of_freedom(kept));
  }
  return size_doubt(kept, solution);
}

}  // namespace

template <class Pose>
void judge_graph(Report& report, const PoseGraphOf<Pose>& graph, const PoseGraphOf<Pose>& kept,
                 const PoseGraphSolutionOf<Pose>& solution) {
  if (!solution.converged) {
    report.status = "not_done";
    report.reason =
        fmt::format("no minimum is reached to the tolerance after {} steps; allow more by --graph-iterations",
                    solution.iterations);
    return;
  }
  report.reason = doubt_sentence(graph, kept, solution);
  if (!report.reason.empty()) report.status = "doubtful";
}

template void judge_graph(Report&, const PoseGraph&, const PoseGraph&, const PoseGraphSolution&);
template void judge_graph(Report&, const PoseGraph3&, const PoseGraph3&, const PoseGraphSolutionOf<Pose3>&);

}  // namespace outrider
