// Can the solution of a pose graph be believed?
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "outrider/report/report.hpp"
#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

template <class Pose>
std::string edge_name(const PoseGraphOf<Pose>& graph, std::uint32_t edge) {
  return fmt::format("from {} to {}", graph.nodes[graph.edges[edge].from].name,
                     graph.nodes[graph.edges[edge].to].name);
}

/// Sets the status and the reason of the report: "not_done" if no minimum was reached; "doubtful" if many
/// edges that are no odometry were refused, or a third of those to one point, if an edge contradicts the
/// others, if the cost is implausible, or if errors that all measurements of a kind share could make the map
/// of a wrong size; else "done". `kept` is the graph without the edges that the solution refused.
template <class Pose>
void judge_graph(Report& report, const PoseGraphOf<Pose>& graph, const PoseGraphOf<Pose>& kept,
                 const PoseGraphSolutionOf<Pose>& solution);

}  // namespace outrider
