#include "laser_loops.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "scan_match.hpp"

namespace outrider {
namespace {

constexpr double try_every_m = 0.8;
constexpr std::uint32_t query_keyframes = 6;  // the last scans, taken together
constexpr std::uint32_t visit_keyframes = 8;  // to both sides of the nearest keyframe of an earlier visit
constexpr std::size_t most_points = 600;
constexpr std::size_t most_candidates = 4;
constexpr double near_variance = 0.01;  // m^2; a relative pose known this well needs no search
constexpr double sensed_m = 4.0;        // visits nearer than this see the same surroundings

constexpr double sds = 3.0;
constexpr double least_reach_m = 0.5, most_reach_m = 6.0;
constexpr double least_turn_rad = 0.1, most_turn_rad = 0.6;

/// Returns the surface points of the last keyframes together, in the frame of the last one.
Surface last_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces) {
  Surface result;
  const std::size_t count = graph.keyframes.size();
  const Pose2& last = graph.keyframes.back().pose;
  for (std::size_t i = count > query_keyframes ? count - query_keyframes : 0; i < count; ++i) {
    const Pose2 pose = relative_pose(last, graph.keyframes[i].pose);
    for (const SurfacePoint& p : surfaces.of(graph, static_cast<std::uint32_t>(i))) {
      result.push_back({pose * p.position, rotated(pose.heading_rad, p.normal)});
    }
  }
  return result;
}

/// Returns the nearest keyframe of each earlier visit that may be at the same place; at most
/// `most_candidates`, the nearest ones.
std::vector<std::uint32_t> candidates(const KeyframeGraph& graph, double uncertain_m) {
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  const std::vector<double> known = graph.variances_from(last, near_variance);
  std::vector<std::pair<double, std::uint32_t>> nearest;
  bool open = false;
  for (std::uint32_t i = 0; i < last; ++i) {
    if (!graph.keyframes[i].has_scan()) continue;
    const double away_m = distance(graph.keyframes[i].pose.position, graph.keyframes[last].pose.position);
    const bool may_be_here = known[i] > near_variance && away_m <= sensed_m + uncertain_m;
    if (may_be_here && !open) nearest.emplace_back(away_m, i);
    if (may_be_here) nearest.back() = std::min(nearest.back(), {away_m, i});
    open = may_be_here;
  }
  std::sort(nearest.begin(), nearest.end());
  if (nearest.size() > most_candidates) nearest.resize(most_candidates);
  std::vector<std::uint32_t> result;
  for (const auto& [away_m, i] : nearest) result.push_back(i);
  return result;
}

/// Returns the surfaces of the keyframes around `scan`, from the same visit.
SurfaceMap map_of_visit(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t scan) {
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  std::vector<SurfaceMap::Part> parts;
  for (std::uint32_t i = scan > visit_keyframes ? scan - visit_keyframes : 0; i <= scan + visit_keyframes;
       ++i) {
    if (i + 2 * query_keyframes < last) parts.push_back({&surfaces.of(graph, i), graph.keyframes[i].pose, 0});
  }
  return SurfaceMap(parts);
}

/// Returns true if the pose lies within `reach_sd` standard deviations of where the keyframe is believed to
/// be.
bool is_plausible(const Keyframe& scan, const Pose2& there, double reach_sd) {
  constexpr double least = 1e-4;  // m^2
  const Eigen::Matrix3d& c = scan.covariance;
  const Eigen::LLT<Eigen::Matrix2d> factor(c.topLeftCorner<2, 2>() + least * Eigen::Matrix2d::Identity());
  const Vec2 gap = there.position - scan.pose.position;
  const Eigen::Vector2d off(gap.x, gap.y);
  return factor.info() == Eigen::Success && off.dot(factor.solve(off)) <= reach_sd * reach_sd;
}

/// Adds a loop constraint from `scan` to the last keyframe and optimises. Undoes both and returns false if
/// the other constraints contradict it.
bool close_loop(KeyframeGraph& graph, std::uint32_t scan, const Fit& fit) {
  constexpr double most_chi2 = 100.0;
  const std::vector<Pose2> before = graph.poses();
  graph.add_constraint(scan, static_cast<std::uint32_t>(graph.keyframes.size() - 1), fit.pose,
                       fit.information + Eigen::Matrix3d::Identity());
  if (graph.optimise() && graph.chi2() <= most_chi2) return true;
  graph.remove_last_constraint(before);
  return false;
}

}  // namespace

bool LoopSearch::close(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd) {
  const Keyframe& last = graph.keyframes.back();
  if (last.way_m - tried_at_m < try_every_m) return false;
  tried_at_m = last.way_m;
  const Eigen::Matrix3d& c = last.covariance;
  const double reach_m = std::clamp(sds * std::sqrt(c(0, 0) + c(1, 1)), least_reach_m, most_reach_m);
  const double turn_rad = std::clamp(sds * std::sqrt(c(2, 2)), least_turn_rad, most_turn_rad);
  const Surface query = thinned(last_surface(graph, surfaces), most_points);
  bool any = false;
  for (const std::uint32_t scan : candidates(graph, reach_m)) {
    const Pose2 here = graph.keyframes.back().pose;  // optimisation moves it
    const auto fit = recognise_place(map_of_visit(graph, surfaces, scan), query,
                                     {here, reach_m, turn_rad, reach_m, turn_rad});
    if (!fit || !is_plausible(graph.keyframes.back(), fit->pose, reach_sd) || !close_loop(graph, scan, *fit))
      continue;
    any = true;
    closed.emplace_back(scan, static_cast<std::uint32_t>(graph.keyframes.size() - 1));
  }
  return any;
}

}  // namespace outrider
