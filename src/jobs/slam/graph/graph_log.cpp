#include "graph/graph_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

#include "outrider/log/append.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_events = 300;

/// Returns the number in a name such as L12 or 12; otherwise that of the node.
std::int64_t id_of(const PoseGraph& graph, NodeIndex node) {
  const std::string& name = graph.nodes[node].name;
  const std::size_t digits = name.find_first_of("0123456789");
  const bool ends = digits != std::string::npos && name.size() - digits <= 15 &&
                    name.find_first_not_of("0123456789", digits) == std::string::npos;
  return ends ? std::atoll(name.c_str() + digits) : static_cast<std::int64_t>(node);
}

Vec2 position_at(const PlanGraph& solved, NodeIndex node) { return solved.poses[node].position; }
Eigen::Matrix3d covariance_at(const PlanGraph& solved, NodeIndex node) {
  return solved.covariances.empty() ? Eigen::Matrix3d(Eigen::Matrix3d::Zero()) : solved.covariances[node];
}

/// Returns the number of landmarks.
std::size_t log_landmarks(Log& log, double end_s, const PlanGraph& solved, const Ways& ways, Box2& box) {
  const PoseGraph& graph = solved.graph;
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
    set_place(landmark, position_at(solved, node), covariance_at(solved, node).topLeftCorner<2, 2>());
    if (!solved.truth.empty()) landmark.truth = point_of(solved.truth[node]);
    box.include(position_at(solved, node));
    message.landmarks.push_back(landmark);
  }
  if (!found.empty()) log.append(topic::landmarks, end_s, std::move(message));
  return found.size();
}

/// Returns the loops in the order in which they are closed.
outrider_msgs::Loops loops_of(const PlanGraph& solved, const Ways& ways) {
  outrider_msgs::Loops message;
  for (const GraphEdge& edge : solved.graph.edges) {
    if (edge.kind != EdgeKind::pose || ways.follow(edge.from, edge.to)) continue;
    message.loops.push_back({std::max(ways.time_s(edge.from), ways.time_s(edge.to)),
                             point_of(position_at(solved, edge.from)),
                             point_of(position_at(solved, edge.to))});
  }
  std::ranges::sort(message.loops, {}, [](const outrider_msgs::Loop& loop) {
    return std::tuple(loop.closed, loop.from.x, loop.from.y, loop.to.x, loop.to.y);
  });
  return message;
}

/// Logs the paths of all robots but that of the longest path, in steps of equal time.
void log_others(Log& log, double end_s, const PlanGraph& solved, const Ways& ways, Box2& box) {
  std::size_t robot = 1;
  for (const std::vector<NodeIndex>& way : ways.all()) {
    if (&way == &ways.main() || way.size() < 2) continue;
    std::vector<double> times_s;
    std::vector<Pose2> poses;
    for (const NodeIndex node : way) {
      times_s.push_back(ways.time_s(node));
      poses.push_back(solved.poses[node]);
      box.include(position_at(solved, node));
    }
    log_trajectory(log, fmt::format("/robot_{}/trajectory", ++robot), end_s, times_s, poses);
  }
}

}  // namespace

Metrics log_graph(Log& to, const SlamScenario& scenario, const PlanGraph& solved) {
  const Ways ways(solved.graph);
  const std::vector<NodeIndex>& way = ways.main();
  SlamLog log(to, scenario, "pose_graph");
  log_event(to, 0.0, "start", fmt::format("optimising starts at the {} guess", solved.start));
  for (std::size_t i = 0; i < std::min(solved.refused.size(), most_events); ++i) {
    log_event(to, 0.0, "refused", fmt::format("the edge {} contradicts the others", solved.refused[i]));
  }
  std::vector<Pose2> settled;
  std::vector<Vec2> reference;
  outrider_msgs::Loops loops = loops_of(solved, ways);
  LogQueue closed;
  for (const outrider_msgs::Loop& loop : loops.loops) {
    if (loops.loops.size() <= most_events) closed.note_event(loop.closed, "loop", "a loop is closed");
  }
  for (std::size_t i = 0; i < way.size(); ++i) {
    settled.push_back(solved.poses[way[i]]);
    closed.flush(to, ways.time_s(way[i]));
    log.note(
        {ways.time_s(way[i]), settled.back(), covariance_at(solved, way[i]), solved.odometry[way[i]], false});
    if (!solved.truth.empty()) reference.push_back(solved.truth[way[i]]);
  }
  Box2 box;
  const std::size_t landmarks = log_landmarks(to, log.end_s(), solved, ways, box);
  const auto count = static_cast<double>(loops.loops.size());
  closed.flush(to, log.end_s());
  to.append(topic::loops, log.end_s(), std::move(loops));
  log_others(to, log.end_s(), solved, ways, box);
  return {{"landmarks", landmarks > 0 ? static_cast<double>(landmarks) : no_number},
          {"loops", count},
          {"distance_m", log.settle(settled, reference, box)},
          {"run_s", log.end_s()}};
}

}  // namespace outrider
