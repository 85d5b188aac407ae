#include "laser/loop_review.hpp"

#include <algorithm>

#include "graph/graduated.hpp"
#include "scan/scan_agreement.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t around_keyframes = 24;  // to both sides of the earlier keyframe
constexpr std::uint32_t latest_keyframes = 24;  // before the later one; constraints to them stay

/// Returns the agreement of the scans since the loop with those of the earlier visit that are near them.
Agreement agreement_since(const KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframePair& loop) {
  constexpr double near_m = 3.0;
  const auto [earlier, later] = loop;
  const std::uint32_t first = earlier > around_keyframes ? earlier - around_keyframes : 0;
  const std::uint32_t end = std::min(earlier + around_keyframes, later);
  Agreement sum;
  for (std::uint32_t q = later + 1; q < graph.keyframes.size(); q += 2) {
    for (std::uint32_t v = first; v < end; v += 2) {
      const Keyframe &now = graph.keyframes[q], &then = graph.keyframes[v];
      if (!now.has_scan() || !then.has_scan() || distance(now.pose.position, then.pose.position) > near_m)
        continue;
      sum += mutual_agreement(now.scan, compose(now.pose, robot_T_laser), then.scan,
                              compose(then.pose, robot_T_laser));
    }
  }
  return sum;
}

bool is_contradiction(const Agreement& agreement) {
  constexpr std::size_t least_points = 200;
  constexpr double most_share = 0.25;
  return agreement.seen() >= least_points && agreement.contradiction() > most_share;
}

/// Returns the sum of r^T W r over the edges, of which a refusable one counts for `most` at most.
double truncated_cost(const PoseGraph& graph, const std::vector<Pose2>& poses,
                      const std::vector<bool>& refusable, double most) {
  double sum = 0.0;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    const Eigen::Vector3d r = residual(edge, poses[edge.from], poses[edge.to]);
    const double cost = r.dot(edge.information * r);
    sum += refusable[i] ? std::min(cost, most) : cost;
  }
  return sum;
}

}  // namespace

bool is_contradicted_since(const KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframePair& loop) {
  return is_contradiction(agreement_since(graph, robot_T_laser, loop));
}

bool undo_loop(KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframePair& loop) {
  const std::vector<KeyframeConstraint> before = graph.constraints();
  const std::vector<Pose2> poses = graph.poses();
  const auto [earlier, later] = loop;
  const std::uint32_t recent = std::max(earlier + 1, later - std::min(later, latest_keyframes));
  std::vector<KeyframeConstraint> kept = before;
  std::erase_if(kept, [&](const KeyframeConstraint& constraint) {
    const bool follows = constraint.edge.to == constraint.edge.from + 1;
    return !follows && constraint.edge.to >= loop.second && constraint.edge.from < recent;
  });
  graph.replace(std::move(kept), poses);
  if (graph.optimise() && !is_contradicted_since(graph, robot_T_laser, loop)) return true;
  graph.replace(before, poses);
  return false;
}

std::optional<std::vector<KeyframeConstraint>> reconciled(const KeyframeGraph& graph,
                                                          std::span<const KeyframeConstraint> rivals,
                                                          double most_chi2) {
  constexpr std::int64_t iterations = 20;
  constexpr int freedoms = 3;
  PoseGraph all = graph.pose_graph();
  for (const KeyframeConstraint& rival : rivals) all.edges.push_back(rival.edge);
  const std::vector<bool> refusable = refusable_edges(all);
  const double most = largest_cost(freedoms);
  for (std::size_t i = 0; i < all.edges.size(); ++i) {
    if (refusable[i]) all.edges[i].information *= most / most_chi2;
  }
  const std::vector<Pose2> present = graph.poses();
  std::vector<Pose2> poses = present;
  BudgetMeter meter({});
  const std::vector<bool> refused = graduated_refusals(all, poses, iterations, meter);
  if (truncated_cost(all, poses, refusable, most) >= truncated_cost(all, present, refusable, most)) return {};
  std::vector<KeyframeConstraint> kept;
  for (std::size_t i = 0; i < graph.constraints().size(); ++i) {
    if (!refused[i]) kept.push_back(graph.constraints()[i]);
  }
  return kept;
}

}  // namespace outrider
