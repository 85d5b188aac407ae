#include "outrider/slam/graph/pose_graph_doubt.hpp"

#include <algorithm>

#include "graph/graduated.hpp"

namespace outrider {

template <class Pose>
GraphDoubt doubt_about(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  constexpr double deviations = 5.0;
  GraphDoubt doubt;
  const double freedom = degrees_of_freedom(graph);
  doubt.cost = freedom > 0.0 && cost(graph, poses) > largest_cost(freedom, deviations);
  const std::vector<bool> refusable = refusable_edges(graph);
  doubt.refusable = static_cast<double>(std::count(refusable.begin(), refusable.end(), true));
  const std::vector<double> changes =
      cost_changes(graph, poses, std::vector<bool>(graph.edges.size(), false));
  double worst = 1.0;  // relative to what is plausible
  for (std::uint32_t i = 0; i < changes.size(); ++i) {
    const double relative = changes[i] / largest_cost(residual_rows<Pose>(graph.edges[i].kind), deviations);
    if (relative <= worst) continue;
    worst = relative;
    doubt.edge = i;
    doubt.edge_cost = changes[i];
  }
  return doubt;
}

template GraphDoubt doubt_about(const PoseGraph&, const std::vector<Pose2>&);
template GraphDoubt doubt_about(const PoseGraph3&, const std::vector<Pose3>&);

}  // namespace outrider
