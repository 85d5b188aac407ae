#include "outrider/slam/graph/pose_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "graph/graduated.hpp"
#include "graph/graph_search.hpp"
#include "graph/trust_region.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

const std::vector<std::string> starts = {"best",          "given",   "odometry",
                                         "spanning_tree", "chordal", "staircase"};
const std::vector<std::string> kernels = {"none", "huber", "cauchy", "geman_mcclure"};
const std::vector<std::string> robust_methods = {"none", "gnc"};

Status check_options(const PoseGraphOptions& options) {
  for (const auto& [names, name, key] :
       {std::tuple(&starts, &options.start, "start"), std::tuple(&kernels, &options.kernel, "kernel"),
        std::tuple(&robust_methods, &options.robust, "robust")}) {
    if (std::find(names->begin(), names->end(), *name) != names->end()) continue;
    return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(*name), fmt::join(*names, ", ")),
                     key);
  }
  return {};
}

}  // namespace

std::vector<Option> describe(PoseGraphOptions& options) {
  return {
      {"start", "", 0, 0,
       "where to begin: given, odometry, spanning_tree, chordal, staircase, or best: all, until one is "
       "proven",
       &options.start},
      {"kernel", "", 0, 0, "loss of an edge that does not fit: none, huber, cauchy or geman_mcclure",
       &options.kernel},
      {"kernel_width", "", 1e-3, 1e6, "standard deviations from which a kernel weighs down",
       &options.kernel_width},
      {"robust", "", 0, 0,
       "gnc: refuse edges that contradict the others, but no odometry, by graduated non-convexity; or none",
       &options.robust},
      {"iterations", "", 1, 100'000, "most steps: of the last descent, and of all before together",
       &options.iterations},
      {"tolerance", "", 1e-15, 1.0,
       "relative decrease of the cost that one more step would make, at which to stop", &options.tolerance}};
}

template <class Pose>
PoseGraphOf<Pose> without_edges(PoseGraphOf<Pose> graph, const std::vector<std::uint32_t>& edges) {
  std::vector<GraphEdgeOf<Pose>> kept;
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    if (!std::binary_search(edges.begin(), edges.end(), i)) kept.push_back(graph.edges[i]);
  }
  graph.edges = std::move(kept);
  return graph;
}

template <class Pose>
double degrees_of_freedom(const PoseGraphOf<Pose>& graph) {
  double result = freedoms<Pose>;  // the first pose is known
  for (const auto& edge : graph.edges) result += residual_rows<Pose>(edge.kind);
  for (const auto& node : graph.nodes) result -= node.is_point ? dimension<Pose> : freedoms<Pose>;
  return result;
}

template <class Pose>
double cost(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  return cost(graph, poses, GraphObjective{});
}

namespace {

/// Refuses the edges that contradict the others most, and takes back those that do not; false if there are
/// none. An edge that was taken back and is refused again stays so. Where the errors of the kept edges are
/// smaller than their information says, so is what is allowed (Pope, NOAA report NOS 65 NGS 1, 1976).
template <class Pose>
bool revise_refusals(const PoseGraphOf<Pose>& graph, const PoseGraphSolutionOf<Pose>& solution,
                     const PoseGraphOf<Pose>& kept, std::vector<bool>& refused,
                     std::vector<bool>& taken_back) {
  constexpr double deviations = 5.0;
  constexpr double rounding = 1e-6;  // of measurements without noise, nothing is an error below this
  const double variance = std::clamp(solution.cost / std::max(1.0, degrees_of_freedom(kept)), rounding, 1.0);
  const std::vector<double> changes = cost_changes(graph, solution.poses, refused);
  double worst = 0.0;
  for (std::size_t i = 0; i < changes.size(); ++i) worst = refused[i] ? worst : std::max(worst, changes[i]);
  bool any = false;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const double most = variance * largest_cost(residual_rows<Pose>(graph.edges[i].kind), deviations);
    const bool contradicts = changes[i] > most;
    const bool change = refused[i] ? !contradicts && !taken_back[i] : contradicts && changes[i] > 0.5 * worst;
    if (!change) continue;
    any = true;
    taken_back[i] = taken_back[i] || refused[i];
    refused[i] = !refused[i];
  }
  return any;
}

/// Refuses edges by graduated non-convexity, then solves without them and revises the refusals until none
/// changes. Where the budget ends, the solution is not converged.
template <class Pose>
Outcome<PoseGraphSolutionOf<Pose>> optimise_graduated(const PoseGraphOf<Pose>& graph,
                                                      const PoseGraphOptions& options, BudgetMeter& meter) {
  const bool chordal = options.start == "best" || options.start == "staircase";
  auto start = graph_start(graph, chordal ? "chordal" : options.start);
  if (!start && chordal) start = graph_start(graph, "given");
  if (!start) return pass_on(start);
  PoseGraphOf<Pose> placed = graph;
  std::vector<bool> refused = graduated_refusals(graph, start->poses, options.iterations, meter);
  std::vector<bool> taken_back(refused.size(), false);
  PoseGraphSolutionOf<Pose> solution;
  solution.poses = std::move(start->poses);
  for (bool revised = true; revised;) {
    for (std::size_t i = 0; i < placed.nodes.size(); ++i) placed.nodes[i].pose = solution.poses[i];
    std::vector<std::uint32_t> without;
    for (std::uint32_t i = 0; i < refused.size(); ++i) {
      if (refused[i]) without.push_back(i);
    }
    const PoseGraphOf<Pose> kept = without_edges(placed, without);
    auto next = search_minimum(kept, options, meter);
    if (!next && solution.descents == 0) return next;
    solution.converged = false;
    if (!next) return solution;
    solution = std::move(*next);
    solution.iterations = static_cast<std::int64_t>(meter.spent());
    solution.refused = std::move(without);
    revised = revise_refusals(graph, solution, kept, refused, taken_back);
  }
  return solution;
}

}  // namespace

template <class Pose>
Outcome<PoseGraphSolutionOf<Pose>> optimise(const PoseGraphOf<Pose>& graph, const PoseGraphOptions& options,
                                            const Budget& budget) {
  if (auto ok = check_options(options); !ok) return pass_on(ok);
  if (auto ok = check(graph); !ok) return pass_on(ok);
  BudgetMeter meter(budget);
  return options.robust == "gnc" ? optimise_graduated(graph, options, meter)
                                 : search_minimum(graph, options, meter);
}

template <class Pose>
Outcome<std::vector<PoseMatrix<Pose>>> marginal_covariances(const PoseGraphOf<Pose>& graph,
                                                            const std::vector<Pose>& poses) {
  if (auto ok = check(graph); !ok) return pass_on(ok);
  if (poses.size() != graph.nodes.size()) {
    return bad_input(
        fmt::format("{} poses for {} nodes; give one for each", poses.size(), graph.nodes.size()));
  }
  constexpr int unused = freedoms<Pose> - dimension<Pose>;
  GraphEquations<Pose> equations(graph, first_pose(graph));
  linearise(graph, poses, GraphObjective{}, equations);
  std::vector<PoseMatrix<Pose>> result = equations.covariances().diagonals;
  if (result.empty()) return bad_input("the measurements do not determine every node; add some");
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (graph.nodes[i].is_point) result[i].template bottomRightCorner<unused, unused>().setZero();
  }
  return result;
}

template PoseGraph without_edges(PoseGraph, const std::vector<std::uint32_t>&);
template PoseGraph3 without_edges(PoseGraph3, const std::vector<std::uint32_t>&);
template double degrees_of_freedom(const PoseGraph&);
template double degrees_of_freedom(const PoseGraph3&);
template double cost(const PoseGraph&, const std::vector<Pose2>&);
template double cost(const PoseGraph3&, const std::vector<Pose3>&);
template Outcome<PoseGraphSolutionOf<Pose2>> optimise(const PoseGraph&, const PoseGraphOptions&,
                                                      const Budget&);
template Outcome<PoseGraphSolutionOf<Pose3>> optimise(const PoseGraph3&, const PoseGraphOptions&,
                                                      const Budget&);
template Outcome<std::vector<PoseMatrix<Pose2>>> marginal_covariances(const PoseGraph&,
                                                                      const std::vector<Pose2>&);
template Outcome<std::vector<PoseMatrix<Pose3>>> marginal_covariances(const PoseGraph3&,
                                                                      const std::vector<Pose3>&);

}  // namespace outrider
