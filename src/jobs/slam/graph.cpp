
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

#include "outrider/io/g2o.hpp"
#include "outrider/io/track_csv.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/slam/map_error.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

using NodeIndex = std::uint32_t;

constexpr double step_s = 0.1;  // graphs have no times
constexpr std::size_t most_events = 300;

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

/// Returns the number of landmarks.
std::size_t log_landmarks(Log& log, double end_s, const Solved& solved, const Ways& ways, Box2& box) {
  const PoseGraph& graph = solved.input.graph;
  std::map<NodeIndex, outrider_msgs::Landmark> found;
  for (const GraphEdge& edge : graph.edges) {
    if (!graph.nodes[edge.to].is_point && !graph.nodes[edge.from].is_point) continue;
    const bool to = graph.nodes[edge.to].is_point;
    const NodeIndex node = to ? edge.to : edge.from, pose = to ? edge.from : edge.to;
    const double time_s = graph.nodes[pose].is_point ? 0.0 : ways.time_s(pose);
    const auto [place, added] = found.try_emplace(node);
    outrider_msgs::Landmark& landmark = place->second;
    landmark.first_seen = added ? time_s : std::min(landmark.first_seen, time_s);
    ++landmark.sightings;
  }
  outrider_msgs::Landmarks message;
  for (auto& [node, landmark] : found) {
    landmark.id = id_of(graph, node);
    set_place(landmark, solved.at(node), solved.covariance(node).topLeftCorner<2, 2>());
    if (!solved.input.truth.empty()) landmark.truth = point_of(solved.true_place(node));
    box.include(solved.at(node));
    message.landmarks.push_back(landmark);
  }
  if (!found.empty()) log.append(topic::landmarks, end_s, std::move(message));
  return found.size();
}

/// Returns the loops in the order in which they are closed.
outrider_msgs::Loops loops_of(const Solved& solved, const Ways& ways) {
  outrider_msgs::Loops message;
  for (const GraphEdge& edge : solved.input.graph.edges) {
    if (edge.kind != EdgeKind::pose || ways.follow(edge.from, edge.to)) continue;
    message.loops.push_back({std::max(ways.time_s(edge.from), ways.time_s(edge.to)),
                             point_of(solved.at(edge.from)), point_of(solved.at(edge.to))});
  }
  std::ranges::sort(message.loops, {}, [](const outrider_msgs::Loop& loop) {
    return std::tuple(loop.closed, loop.from.x, loop.from.y, loop.to.x, loop.to.y);
  });
  return message;
}

/// Logs the paths of all robots but that of the longest path, in steps of equal time.
void log_others(Log& log, double end_s, const Solved& solved, const Ways& ways, Box2& box) {
  std::size_t robot = 1;
  for (const std::vector<NodeIndex>& way : ways.all()) {
    if (&way == &ways.main() || way.size() < 2) continue;
    std::vector<double> times_s;
    std::vector<Pose2> poses;
    for (const NodeIndex node : way) {
      times_s.push_back(ways.time_s(node));
      poses.push_back(solved.solution.poses[node]);
      box.include(solved.at(node));
    }
    log_trajectory(log, fmt::format("/robot_{}/trajectory", ++robot), end_s, times_s, poses);
  }
}

/// Logs the graph. The longest path is that of the robot. A graph is solved at once, so the believed poses
/// are the final poses. Returns the metrics of the log.
Metrics log_graph(Log& to, const SlamScenario& scenario, const Solved& solved) {
  const Ways ways(solved.input.graph);
  const std::vector<NodeIndex>& way = ways.main();
  SlamLog log(to, scenario, "pose_graph");
  log_event(to, 0.0, "start", fmt::format("optimising starts at the {} guess", solved.solution.start));
  std::vector<Pose2> settled;
  std::vector<Vec2> reference;
  Pose2 odometry = solved.solution.poses[way.front()];
  outrider_msgs::Loops loops = loops_of(solved, ways);
  LogQueue closed;
  for (const outrider_msgs::Loop& loop : loops.loops) {
    if (loops.loops.size() <= most_events) closed.note_event(loop.closed, "loop", "a loop is closed");
  }
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) odometry = compose(odometry, ways.motion(way[i - 1], way[i]));
    settled.push_back(solved.solution.poses[way[i]]);
    closed.flush(to, ways.time_s(way[i]));
    log.note({ways.time_s(way[i]), settled.back(), solved.covariance(way[i]), odometry, false});
    if (!solved.input.truth.empty()) reference.push_back(solved.true_place(way[i]));
  }
  Box2 box;
  const std::size_t landmarks = log_landmarks(to, log.end_s(), solved, ways, box);
  const auto count = static_cast<double>(loops.loops.size());
  closed.flush(to, log.end_s());
  to.append(topic::loops, log.end_s(), std::move(loops));
  log_others(to, log.end_s(), solved, ways, box);
  return {{"landmarks", landmarks > 0 ? static_cast<double>(landmarks) : unknown},
          {"loops", count},
          {"distance_m", log.settle(settled, reference, box)},
          {"run_s", log.end_s()}};
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

Status solve_graph(const SlamJob& job, GraphInput input, Run& run, const RunWatch& watch) {
  const SlamScenario& scenario = job.scenario;
  if (scenario.measured_frame) input.graph = in_measured_frame(std::move(input.graph));
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("optimising"); !ok) return ok;
  const double began_s = wall_s();
  const auto solution = optimise(input.graph, scenario.graph, watch.budget());
  const double time_s = wall_s() - began_s;
  if (!solution) return tl::unexpected<Fault>(solution.error());
  const auto marginals = marginal_covariances(input.graph, solution->poses);
  const std::vector<Eigen::Matrix3d> covariances = marginals ? *marginals : std::vector<Eigen::Matrix3d>();
  run.report.metrics = metrics_of(input, *solution);
  const Metrics logged =
      log_graph(run.log, scenario, {input, *solution, covariances, alignment_to_map(input, solution->poses)});
  run.report.metrics.insert(run.report.metrics.end(), logged.begin(), logged.end());
  if (!solution->converged) {
    run.report.status = "not_done";
    run.report.reason = fmt::format("the cost still falls after {} steps; allow more by --graph-iterations",
                                    solution->iterations);
  }
  run.report.machine_times = {
      {"time_s", time_s},
      {"max_step_s", time_s / static_cast<double>(std::max<std::int64_t>(1, solution->iterations))}};
  run.files = {{"track.csv", track_csv(solution->poses)}};
  if (auto g2o = to_g2o(input.graph, solution->poses)) run.files.push_back({"graph.g2o", *g2o});
  return {};
}

}  // namespace outrider
