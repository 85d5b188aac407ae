#include "graph/graph_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "bounds/staircase.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"

namespace outrider {
namespace {

constexpr double equal = 1e-3;    ///< relative difference of costs that count as the same
constexpr double roughly = 1e-4;  ///< tolerance of a descent until it is known to be the best

/// Returns the limits of each of several descents: roughly, and a part of the steps.
DescentLimits first_limits(const PoseGraphOptions& options) {
  constexpr std::int64_t part = 8;
  if (options.start != "best") return {options.iterations, options.tolerance};
  return {(options.iterations + part - 1) / part, std::max(roughly, options.tolerance)};
}

/// Returns true if the staircase knows all kinds of edges.
template <class Pose>
bool can_climb(const PoseGraphOf<Pose>& graph) {
  return std::none_of(graph.edges.begin(), graph.edges.end(),
                      [](const auto& edge) { return edge.kind == EdgeKind::range; });
}

/// Goes down from several starts, roughly, and keeps the lowest end.
template <class Pose>
class Search {
 public:
  Search(const PoseGraphOf<Pose>& graph, const PoseGraphOptions& options, BudgetMeter& meter)
      : graph_(graph),
        options_(options),
        first_(first_limits(options)),
        meter_(meter),
        equations_(graph, first_pose(graph)) {}

  /// Returns true while another descent may find more: there is budget, and the lowest cost was found once.
  [[nodiscard]] bool goes_on() const {
    return !spent_ && !proven_ && agreeing_ < 2 && iterations_ < options_.iterations;
  }

  void descend_from(const GraphStart<Pose>& start) {
    keep(start, begin_descent(graph_, plain(), start.poses));
  }

  /// Follows the best descent to its end; no other is needed if no poses can cost noticeably less.
  void try_to_prove() {
    if (!best_ || options_.kernel != "none") return;
    follow_best();
    const auto bound = least_cost_bound(graph_, best_->poses);
    proven_ = bound && best_->cost - *bound <= equal * best_->cost;
  }

  /// Climbs the Riemannian staircase from these poses, and descends from its top.
  void climb_from(const std::vector<Pose>& poses) {
    auto top =
        climb_staircase(graph_, poses, std::max<std::int64_t>(1, options_.iterations - iterations_), meter_);
    iterations_ += top.iterations;
    descend_from({std::move(top.poses), "staircase"});
  }
  void climb_from_best() {
    if (best_ && options_.kernel == "none" && can_climb(graph_)) climb_from(best_->poses);
  }

  /// Goes down under a kernel first, by which edges that contradict the others do not bend the graph.
  void descend_softly(const GraphStart<Pose>& start, double kernel_width) {
    const GraphObjective soft = {.kernel = "geman_mcclure", .kernel_width = kernel_width};
    Descent<Pose> descent = begin_descent(graph_, soft, start.poses);
    proceed(soft, first_, descent);
    if (!spent_) keep(start, begin_descent(graph_, plain(), std::move(descent.poses)));
  }

  /// Follows the best descent to its end; empty if there was no budget for any.
  std::optional<PoseGraphSolutionOf<Pose>> finish() {
    if (!best_) return std::nullopt;
    follow_best();
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
  void follow_best() {
    if (first_.tolerance <= options_.tolerance || best_->end == DescentEnd::stuck) return;
    best_->end = DescentEnd::none;
    proceed(plain(), {options_.iterations, options_.tolerance}, *best_);
  }
  void proceed(const GraphObjective& objective, const DescentLimits& limits, Descent<Pose>& descent) {
    const std::int64_t before = descent.iterations;
    spent_ = !descend(graph_, objective, limits, equations_, descent, meter_);
    iterations_ += descent.iterations - before;
  }
  void keep(const GraphStart<Pose>& start, Descent<Pose> descent) {
    proceed(plain(), first_, descent);
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
  DescentLimits first_;  ///< of each descent, before the best is followed to its end
  BudgetMeter& meter_;
  GraphEquations<Pose> equations_;
  std::optional<Descent<Pose>> best_;
  GraphStart<Pose> start_;
  std::int64_t iterations_ = 0;
  int descents_ = 0, agreeing_ = 0;
  bool spent_ = false, proven_ = false;
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

/// Descends from the starts in turn until the lowest cost is proven or has been found twice: first as they
/// are, then under ever narrower kernels. Those made from the edges come first, because they close the loops.
/// Where they disagree, the staircase begins at the best.
template <class Pose>
void descend_from_all(const PoseGraphOf<Pose>& graph, Search<Pose>& search) {
  constexpr std::array<std::array<const char*, 2>, 2> all = {
      {{"chordal", "spanning_tree"}, {"given", "odometry"}}};
  for (const auto& names : all) {
    const std::vector<GraphStart<Pose>> some = different_starts(graph, names);
    for (const auto& start : some) {
      if (search.goes_on()) search.descend_from(start);
      if (&names == &all.front() && &start == &some.front()) search.try_to_prove();
    }
    for (const double kernel_width : {3.0, 2.0, 1.0}) {
      for (const auto& start : some) {
        if (search.goes_on()) search.descend_softly(start, kernel_width);
      }
    }
    if (&names == &all.front() && search.goes_on()) search.climb_from_best();
  }
}

}  // namespace

template <class Pose>
Outcome<PoseGraphSolutionOf<Pose>> search_minimum(const PoseGraphOf<Pose>& graph,
                                                  const PoseGraphOptions& options, BudgetMeter& meter) {
  Search<Pose> search(graph, options, meter);
  if (options.start == "best") {
    descend_from_all(graph, search);
  } else if (options.start == "staircase") {
    if (!can_climb(graph)) return bad_input("the staircase knows no ranges; take another start", "start");
    const auto start = graph_start(graph, "chordal");
    search.climb_from(start ? start->poses : poses_of(graph));
  } else {
    auto start = graph_start(graph, options.start);
    if (!start) return pass_on(start);
    search.descend_from(*start);
  }
  auto solution = search.finish();
  if (!solution) return meter.refusal();
  return std::move(*solution);
}

template Outcome<PoseGraphSolutionOf<Pose2>> search_minimum(const PoseGraph&, const PoseGraphOptions&,
                                                            BudgetMeter&);
template Outcome<PoseGraphSolutionOf<Pose3>> search_minimum(const PoseGraph3&, const PoseGraphOptions&,
                                                            BudgetMeter&);

}  // namespace outrider
