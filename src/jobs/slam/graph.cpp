
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>

#include "opened.hpp"
#include "outrider/io/g2o.hpp"
#include "outrider/io/track_csv.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/report/slam_record.hpp"
#include "outrider/slam/map_error.hpp"
#include "slam_picture.hpp"

namespace outrider {
namespace {

using NodeIndex = std::uint32_t;

constexpr double step_s = 0.1;  // graphs have no times
constexpr std::size_t most_waypoints = 4000;
constexpr std::size_t most_events = 300;

/// Makes the picture; loops are edges between poses that are not consecutive.
SlamPicture picture_of(const PoseGraph& graph, const PoseGraphSolution& solution,
                       const std::vector<Eigen::Matrix3d>& covariances) {
  SlamPicture picture;
  const auto at = [&](NodeIndex node) { return solution.poses[node].position; };
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) continue;
    const bool follows = edge.to == edge.from + 1;
    (follows ? picture.driven : picture.loops).push_back({at(edge.from), at(edge.to)});
  }
  for (NodeIndex i = 0; i < graph.nodes.size() && !covariances.empty(); ++i) {
    if (!graph.nodes[i].is_point) continue;
    const Eigen::Matrix3d& c = covariances[i];
    picture.landmarks.push_back({i, at(i), c.topLeftCorner<2, 2>(), 0});
  }
  return picture;
}

/// Estimated positions of the points, or of the poses, and their true positions.
struct Compared {
  std::vector<Vec2> estimate;
  std::vector<Vec2> truth;
};

Compared compared(const GraphInput& input, const std::vector<Pose2>& poses, bool points) {
  Compared places;
  for (std::size_t i = 0; i < input.truth.size(); ++i) {
    if (input.graph.nodes[i].is_point != points) continue;
    places.estimate.push_back(poses[i].position);
    places.truth.push_back(input.truth[i].position);
  }
  return places;
}

/// The kind of an error: its subject, and the alignment of the estimate.
struct ErrorKind {
  bool points = false;  ///< error of the landmarks; otherwise of the poses
  bool aligned = true;
};

/// Returns the root mean square error of the landmarks or of the poses.
std::optional<double> aligned_error(const GraphInput& input, const std::vector<Pose2>& poses,
                                    ErrorKind kind) {
  const auto [estimate, truth] = compared(input, poses, kind.points);
  return rms_distance(estimate, truth, kind.aligned ? rigid_alignment(estimate, truth) : Pose2{});
}

/// Paths of robots through a graph: consecutive poses, each joined to the next by an edge.
class Ways {
 public:
  explicit Ways(const PoseGraph& graph) : graph_(graph), step_of_(graph.nodes.size(), 0) {
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const GraphEdge& edge = graph.edges[i];
      if (edge.kind == EdgeKind::pose) edge_between_.try_emplace(std::minmax(edge.from, edge.to), i);
    }
    std::optional<NodeIndex> before;
    for (NodeIndex node = 0; node < graph.nodes.size(); ++node) {
      if (graph.nodes[node].is_point) continue;
      if (!before || !edge_between_.contains({*before, node})) all_.emplace_back();
      step_of_[node] = all_.back().size();
      all_.back().push_back(node);
      before = node;
    }
  }

  [[nodiscard]] const std::vector<std::vector<NodeIndex>>& all() const { return all_; }
  /// Returns the first of the longest paths.
  [[nodiscard]] const std::vector<NodeIndex>& main() const {
    return *std::ranges::max_element(all_, {}, &std::vector<NodeIndex>::size);
  }
  /// Returns the time at which a pose was reached; every robot starts at 0.
  [[nodiscard]] double time_s(NodeIndex node) const { return step_s * static_cast<double>(step_of_[node]); }
  [[nodiscard]] bool follow(NodeIndex a, NodeIndex b) const {
    const auto [first, second] = std::minmax(a, b);
    return step_of_[second] == step_of_[first] + 1 && next_to(first, second);
  }
  /// Returns the measured motion from a pose of a path to the next.
  [[nodiscard]] Pose2 motion(NodeIndex from, NodeIndex to) const {
    const GraphEdge& edge = graph_.edges[edge_between_.at({from, to})];
    return edge.from == from ? edge.measured : wrap_heading(inverse(edge.measured));
  }

 private:
  [[nodiscard]] bool next_to(NodeIndex a, NodeIndex b) const {
    for (NodeIndex node = a + 1; node < b; ++node) {
      if (!graph_.nodes[node].is_point) return false;
    }
    return true;
  }

  const PoseGraph& graph_;
  std::vector<std::size_t> step_of_;  ///< by node: its position in its path
  std::map<std::pair<NodeIndex, NodeIndex>, std::size_t> edge_between_;
  std::vector<std::vector<NodeIndex>> all_;
};

/// Returns the number in a name such as L12 or 12; otherwise that of the node.
std::int64_t id_of(const PoseGraph& graph, NodeIndex node) {
  const std::string& name = graph.nodes[node].name;
  const std::size_t digits = name.find_first_of("0123456789");
  const bool ends = digits != std::string::npos && name.size() - digits <= 15 &&
                    name.find_first_not_of("0123456789", digits) == std::string::npos;
  return ends ? std::atoll(name.c_str() + digits) : static_cast<std::int64_t>(node);
}

struct Solved {
  const GraphInput& input;
  const PoseGraphSolution& solution;
  const std::vector<Eigen::Matrix3d>& covariances;  ///< by node; or empty
  Pose2 map_T_truth;

  [[nodiscard]] Vec2 at(NodeIndex node) const { return solution.poses[node].position; }
  [[nodiscard]] Vec2 true_place(NodeIndex node) const { return map_T_truth * input.truth[node].position; }
  [[nodiscard]] Eigen::Matrix3d covariance(NodeIndex node) const {
    return covariances.empty() ? Eigen::Matrix3d(Eigen::Matrix3d::Zero()) : covariances[node];
  }
};

void add_landmarks(Report& report, const Solved& solved, const Ways& ways) {
  const PoseGraph& graph = solved.input.graph;
  std::map<NodeIndex, ReportLandmark> found;
  for (const GraphEdge& edge : graph.edges) {
    if (!graph.nodes[edge.to].is_point && !graph.nodes[edge.from].is_point) continue;
    const bool to = graph.nodes[edge.to].is_point;
    const NodeIndex node = to ? edge.to : edge.from, pose = to ? edge.from : edge.to;
    const double time_s = graph.nodes[pose].is_point ? 0.0 : ways.time_s(pose);
    const auto [place, added] = found.try_emplace(node);
    ReportLandmark& landmark = place->second;
    landmark.first_s = added ? time_s : std::min(landmark.first_s, time_s);
    ++landmark.sightings;
  }
  for (auto& [node, landmark] : found) {
    const Eigen::Matrix3d c = solved.covariance(node);
    const ReportSigmas sigmas = sigmas_of(c(0, 0), c(0, 1), c(1, 1));
    landmark.id = id_of(graph, node);
    landmark.position = solved.at(node);
    landmark.sigma_x_m = sigmas.x_m;
    landmark.sigma_y_m = sigmas.y_m;
    landmark.correlation = sigmas.correlation;
    if (!solved.input.truth.empty()) landmark.truth = solved.true_place(node);
    report.slam->landmarks.push_back(landmark);
  }
}

void add_loops(Report& report, const Solved& solved, const Ways& ways) {
  std::vector<ReportLoop>& loops = report.slam->loops;
  for (const GraphEdge& edge : solved.input.graph.edges) {
    if (edge.kind != EdgeKind::pose || ways.follow(edge.from, edge.to)) continue;
    loops.push_back(
        {std::max(ways.time_s(edge.from), ways.time_s(edge.to)), solved.at(edge.from), solved.at(edge.to)});
  }
  std::ranges::sort(loops, {}, [](const ReportLoop& loop) {
    return std::tuple(loop.time_s, loop.from.x, loop.from.y, loop.to.x, loop.to.y);
  });
  report.metrics.emplace_back("loops", static_cast<double>(loops.size()));
  if (loops.size() > most_events) return;
  for (const ReportLoop& loop : loops) report.events.push_back({loop.time_s, "loop", "a loop is closed"});
}

/// Adds the paths of several robots, in steps of equal time.
void add_paths(Report& report, const Solved& solved, const Ways& ways) {
  if (ways.all().size() < 2) return;
  for (const std::vector<NodeIndex>& way : ways.all()) {
    if (way.size() < 2) continue;
    const std::size_t every = (way.size() + most_waypoints - 1) / most_waypoints;
    ReportPath path;
    for (std::size_t i = 0; i < way.size(); i += every) {
      path.waypoints.push_back(solved.at(way[i]));
      path.end_s = step_s * static_cast<double>(i);
    }
    report.paths.push_back(std::move(path));
  }
}

/// Makes the report. The longest path is the track. A graph is solved at once, so the believed poses are the
/// final poses.
Report report_of(const SlamScenario& scenario, const Solved& solved) {
  Report report = opened(scenario);
  const Ways ways(solved.input.graph);
  const std::vector<NodeIndex>& way = ways.main();
  SlamRecord record(report, "pose_graph", 0.0);
  std::vector<Pose2> settled;
  std::vector<Vec2> reference;
  Pose2 odometry = solved.solution.poses[way.front()];
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) odometry = compose(odometry, ways.motion(way[i - 1], way[i]));
    settled.push_back(solved.solution.poses[way[i]]);
    record.note({ways.time_s(way[i]), settled.back(), solved.covariance(way[i]), odometry, false});
    if (!solved.input.truth.empty()) reference.push_back(solved.true_place(way[i]));
  }
  report.start = settled.front();
  add_landmarks(report, solved, ways);
  add_loops(report, solved, ways);
  add_paths(report, solved, ways);
  record.settle(settled, reference);
  return report;
}

Pose2 alignment_to_map(const GraphInput& input, const std::vector<Pose2>& poses) {
  const auto [estimate, truth] = compared(input, poses, false);
  return truth.empty() ? Pose2{} : rigid_alignment(truth, estimate);
}

Metrics metrics_of(const GraphInput& input, const PoseGraphSolution& solution) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  return {
      {"landmark_rmse_m", known(aligned_error(input, solution.poses, {.points = true, .aligned = false}))},
      {"landmark_rmse_aligned_m",
       known(aligned_error(input, solution.poses, {.points = true, .aligned = true}))},
      {"ate_m", known(aligned_error(input, solution.poses, {.points = false, .aligned = true}))},
      {"cost", solution.cost},
      {"steps", number(solution.iterations)},
      {"nodes", number(input.graph.nodes.size())},
      {"edges", number(input.graph.edges.size())},
      {"start_cost", solution.start_cost},
      {"robust_cost", solution.robust_cost}};
}

}  // namespace

Outcome<Run> solve_graph(const SlamJob& job, GraphInput input, const RunWatch& watch) {
  const SlamScenario& scenario = job.scenario;
  if (scenario.measured_frame) input.graph = in_measured_frame(std::move(input.graph));
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("optimising"); !ok) return pass_on(ok);
  const double began_s = wall_s();
  const auto solution = optimise(input.graph, scenario.graph, watch.budget());
  const double time_s = wall_s() - began_s;
  if (!solution) return tl::unexpected<Fault>(solution.error());
  const auto marginals = marginal_covariances(input.graph, solution->poses);
  const std::vector<Eigen::Matrix3d> covariances = marginals ? *marginals : std::vector<Eigen::Matrix3d>();
  Report report =
      report_of(scenario, {input, *solution, covariances, alignment_to_map(input, solution->poses)});
  if (!solution->converged) {
    report.status = "not_done";
    report.reason = fmt::format("the cost still falls after {} steps; allow more by --graph-iterations",
                                solution->iterations);
  }
  conclude(report, metrics_of(input, *solution));
  report.machine_times = {
      {"time_s", time_s},
      {"max_step_s", time_s / static_cast<double>(std::max<std::int64_t>(1, solution->iterations))}};
  report.events.insert(report.events.begin(),
                       {0.0, "start", fmt::format("optimising starts at the {} guess", solution->start)});
  Run run{std::move(report),
          {{"track.csv", track_csv(solution->poses)},
           {"slam.svg", to_svg(picture_of(input.graph, *solution, covariances))}}};
  if (auto g2o = to_g2o(input.graph, solution->poses)) run.files.push_back({"graph.g2o", *g2o});
  return run;
}

}  // namespace outrider
