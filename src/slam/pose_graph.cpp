#include "outrider/slam/pose_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "trust_region.hpp"

namespace outrider {
namespace {

const std::vector<std::string> starts = {"best", "given", "odometry", "spanning_tree", "chordal"};
const std::vector<std::string> kernels = {"none", "huber", "cauchy", "geman_mcclure"};

Status check_options(const PoseGraphOptions& options) {
  for (const auto& [names, name, key] :
       {std::tuple(&starts, &options.start, "start"), std::tuple(&kernels, &options.kernel, "kernel")}) {
    if (std::find(names->begin(), names->end(), *name) != names->end()) continue;
    return bad_input(fmt::format("'{}' is not valid; expected {}", *name, fmt::join(*names, ", ")), key);
  }
  return {};
}

constexpr double roughly = 1e-4;  ///< tolerance of a descent until it is known to be the best

/// Goes down from several starts, roughly, and keeps the lowest end.
template <class Pose>
class Search {
 public:
  Search(const PoseGraphOf<Pose>& graph, const PoseGraphOptions& options, const Budget& budget)
      : graph_(graph),
        options_(options),
        tolerance_(options.start == "best" ? std::max(roughly, options.tolerance) : options.tolerance),
        meter_(budget),
        equations_(graph, first_pose(graph)) {}

  /// Returns true while another descent may find more: there is budget, and the lowest cost was found once.
  [[nodiscard]] bool goes_on() const { return !spent_ && agreeing_ < 2; }
  [[nodiscard]] tl::unexpected<Fault> refusal() const { return meter_.refusal(); }

  void descend_from(const GraphStart<Pose>& start) {
    keep(start, begin_descent(graph_, plain(), start.poses));
  }

  /// Goes down under a kernel first, by which edges that contradict the others do not bend the graph.
  void descend_softly(const GraphStart<Pose>& start, double kernel_width) {
    const GraphObjective soft = {.kernel = "geman_mcclure", .kernel_width = kernel_width};
    Descent<Pose> descent = begin_descent(graph_, soft, start.poses);
    proceed(soft, tolerance_, descent);
    if (!spent_) keep(start, begin_descent(graph_, plain(), std::move(descent.poses)));
  }

  /// Follows the best descent to its end; empty if there was no budget for any.
  std::optional<PoseGraphSolutionOf<Pose>> finish() {
    if (!best_) return std::nullopt;
    if (tolerance_ > options_.tolerance) {
      best_->end = DescentEnd::none;
      proceed(plain(), options_.tolerance, *best_);
    }
    PoseGraphSolutionOf<Pose> solution;
    solution.cost = cost(graph_, best_->poses);
    solution.start_cost = cost(graph_, start_.poses);
    solution.robust_cost = best_->cost;
    solution.poses = std::move(best_->poses);
    solution.iterations = iterations_;
    solution.start = start_.name;
    solution.converged = best_->end == DescentEnd::converged;
    solution.descents = descents_;
    solution.descents_agreeing = agreeing_;
    return solution;
  }

 private:
  [[nodiscard]] GraphObjective plain() const {
    return {.kernel = options_.kernel, .kernel_width = options_.kernel_width};
  }
  void proceed(const GraphObjective& objective, double tolerance, Descent<Pose>& descent) {
    const std::int64_t before = descent.iterations;
    spent_ = !descend(graph_, objective, {options_.iterations, tolerance}, equations_, descent, meter_);
    iterations_ += descent.iterations - before;
  }
  void keep(const GraphStart<Pose>& start, Descent<Pose> descent) {
    constexpr double equal = 10.0 * roughly;
    proceed(plain(), tolerance_, descent);
    if (descent.iterations == 0) return;
    ++descents_;
    const double gap = best_ ? descent.cost - best_->cost : -HUGE_VAL;
    const bool agrees = std::abs(gap) <= equal * std::max(descent.cost, 1e-3);
    agreeing_ = agrees ? agreeing_ + 1 : gap < 0.0 ? 1 : agreeing_;
    if (gap >= 0.0) return;
    best_ = std::move(descent);
    start_ = start;
  }

  const PoseGraphOf<Pose>& graph_;
  const PoseGraphOptions& options_;
  double tolerance_;
  BudgetMeter meter_;
  GraphEquations<Pose> equations_;
  std::optional<Descent<Pose>> best_;
  GraphStart<Pose> start_;
  std::int64_t iterations_ = 0;
  int descents_ = 0, agreeing_ = 0;
  bool spent_ = false;
};

/// Returns the starts of these names that exist, each once.
template <class Pose>
std::vector<GraphStart<Pose>> different_starts(const PoseGraphOf<Pose>& graph,
                                               const std::array<const char*, 2>& names) {
  std::vector<GraphStart<Pose>> result;
  std::vector<double> costs;
  for (const char* name : names) {
    auto start = graph_start(graph, name);
    if (!start) continue;
    costs.push_back(cost(graph, start->poses));
    if (std::count(costs.begin(), costs.end(), costs.back()) == 1) result.push_back(std::move(*start));
  }
  return result;
}

/// Descends from the starts in turn until the lowest cost has been found twice: first as they are, then under
/// ever narrower kernels. Those made from the edges come first, because they close the loops.
template <class Pose>
void descend_from_all(const PoseGraphOf<Pose>& graph, Search<Pose>& search) {
  constexpr std::array<std::array<const char*, 2>, 2> all = {
      {{"chordal", "spanning_tree"}, {"given", "odometry"}}};
  for (const auto& names : all) {
    const std::vector<GraphStart<Pose>> some = different_starts(graph, names);
    for (const auto& start : some) {
      if (search.goes_on()) search.descend_from(start);
    }
    for (const double kernel_width : {3.0, 2.0, 1.0}) {
      for (const auto& start : some) {
        if (search.goes_on()) search.descend_softly(start, kernel_width);
      }
    }
  }
}

}  // namespace

std::vector<Option> describe(PoseGraphOptions& options) {
  return {
      {"start", "", 0, 0,
       "where to begin: given (by the file), odometry, spanning_tree, chordal (a relaxation), or best: all "
       "of "
       "them until two agree",
       &options.start},
      {"kernel", "", 0, 0, "loss of an edge that does not fit: none, huber, cauchy or geman_mcclure",
       &options.kernel},
      {"kernel_width", "", 1e-3, 1e6, "standard deviations from which a kernel weighs down",
       &options.kernel_width},
      {"iterations", "", 1, 100'000, "most steps of one descent", &options.iterations},
      {"tolerance", "", 1e-15, 1.0,
       "relative decrease of the cost that one more step would make, at which to stop", &options.tolerance}};
}

template <class Pose>
double cost(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses) {
  return cost(graph, poses, GraphObjective{});
}

template <class Pose>
Outcome<PoseGraphSolutionOf<Pose>> optimise(const PoseGraphOf<Pose>& graph, const PoseGraphOptions& options,
                                            const Budget& budget) {
  if (auto ok = check_options(options); !ok) return pass_on(ok);
  if (auto ok = check(graph); !ok) return pass_on(ok);
  Search<Pose> search(graph, options, budget);
  if (options.start == "best") {
    descend_from_all(graph, search);
  } else {
    auto start = graph_start(graph, options.start);
    if (!start) return pass_on(start);
    search.descend_from(*start);
  }
  auto solution = search.finish();
  if (!solution) return search.refusal();
  return std::move(*solution);
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
