#include "laser_loops.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "outrider/geometry/box.hpp"
#include "scan_agreement.hpp"
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

constexpr double least_reach_m = 0.5, most_reach_m = 6.0;
constexpr double least_turn_rad = 0.1, most_turn_rad = 0.6;
constexpr double adrift_rad = 0.7;  // standard deviation of a heading from which the full turn is searched

/// Returns the first of the last keyframes, from `first` on.
std::size_t first_of_last(const KeyframeGraph& graph, std::size_t first, std::size_t most = query_keyframes) {
  const std::size_t count = graph.keyframes.size();
  return std::max(first, count > most ? count - most : 0);
}

/// Returns the surface points of the last keyframes together, from `first` on, in the frame of the last one.
Surface last_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::size_t first,
                     std::size_t most = query_keyframes) {
  Surface result;
  const Pose2& last = graph.keyframes.back().pose;
  for (std::size_t i = first_of_last(graph, first, most); i < graph.keyframes.size(); ++i) {
    const Pose2 pose = relative_pose(last, graph.keyframes[i].pose);
    for (const SurfacePoint& p : surfaces.of(graph, static_cast<std::uint32_t>(i))) {
      result.push_back({pose * p.position, rotated(pose.heading_rad, p.normal)});
    }
  }
  return result;
}

/// Returns the nearest keyframe of each earlier visit, from `first` on, that may be at the same place; at
/// most `most_candidates`, the nearest ones.
std::vector<std::uint32_t> candidates(const KeyframeGraph& graph, double uncertain_m, std::uint32_t first) {
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  const std::vector<double> known = graph.variances_from(last, near_variance);
  std::vector<std::pair<double, std::uint32_t>> nearest;
  bool open = false;
  for (std::uint32_t i = first; i < last; ++i) {
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

/// Keyframes from `first` to before `end`.
struct Visit {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Returns the keyframes around one, without the last ones.
Visit visit_of(const KeyframeGraph& graph, std::uint32_t scan) {
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  constexpr std::uint32_t apart = 2 * query_keyframes;
  return {scan > visit_keyframes ? scan - visit_keyframes : 0,
          std::min(scan + visit_keyframes + 1, last > apart ? last - apart : 0)};
}

SurfaceMap map_of(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, const Visit& visit,
                  int levels = SurfaceMap::few_levels) {
  std::vector<SurfaceMap::Part> parts;
  for (std::uint32_t i = visit.first; i < visit.end; ++i)
    parts.push_back({&surfaces.of(graph, i), graph.keyframes[i].pose, 0});
  return SurfaceMap(parts, levels);
}

/// Returns true if the last keyframe is the first one after another half of the way since the gap, from 2 m
/// on.
bool is_search_due(const KeyframeGraph& graph, std::uint32_t gap) {
  constexpr double first_m = 2.0, growth = 1.5;
  const std::size_t last = graph.keyframes.size() - 1;
  const auto since_m = [&](std::size_t i) { return graph.keyframes[i].way_m - graph.keyframes[gap].way_m; };
  double at_m = first_m;
  while (at_m <= since_m(last - 1)) at_m *= growth;
  return last > gap && at_m <= since_m(last);
}

/// Returns the window that holds all places of a visit, in the full turn.
MatchWindow whole_window(const KeyframeGraph& graph, const Visit& visit) {
  constexpr double margin_m = 2.0;
  Box2 box;
  for (std::uint32_t i = visit.first; i < visit.end; ++i) box.include(graph.keyframes[i].pose.position);
  const Vec2 size = box.size();
  return {{0.5 * (box.low + box.high), 0.0}, 0.5 * std::max(size.x, size.y) + margin_m, std::numbers::pi};
}

/// Returns the keyframe of a visit that is nearest to a place, of those that have a scan.
std::uint32_t nearest_in(const KeyframeGraph& graph, const Visit& visit, Vec2 place) {
  std::uint32_t nearest = visit.first;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = visit.first; i < visit.end; ++i) {
    const double away_m = distance(graph.keyframes[i].pose.position, place);
    if (!graph.keyframes[i].has_scan() || away_m >= least_m) continue;
    least_m = away_m;
    nearest = i;
  }
  return nearest;
}

/// Returns true if the scans of the last keyframes, from `first` on, and those of a visit contradict each
/// other with the last keyframe at `there`: too many points of the one are where the other looked through.
bool is_contradicted(const KeyframeGraph& graph, const Pose2& robot_T_laser, const Visit& visit,
                     std::size_t first, const Pose2& there) {
  constexpr std::size_t least_points = 40;
  constexpr double most_share = 0.1;
  const Pose2 moved = compose(there, relative_pose(graph.keyframes.back().pose, Pose2{}));
  Agreement sum;
  for (std::size_t q = first_of_last(graph, first); q < graph.keyframes.size(); q += 2) {
    const Pose2 pose = compose(compose(moved, graph.keyframes[q].pose), robot_T_laser);
    for (std::uint32_t v = visit.first; v < visit.end; v += 2) {
      const Keyframe& key = graph.keyframes[v];
      if (key.has_scan())
        sum += mutual_agreement(graph.keyframes[q].scan, pose, key.scan, compose(key.pose, robot_T_laser));
    }
  }
  return sum.seen() >= least_points && sum.contradiction() > most_share;
}

/// Returns true if the pose lies within `reach_sd` standard deviations of where the keyframe is believed to
/// be.
bool is_plausible(const KeyframeGraph& graph, const Pose2& there, double reach_sd) {
  constexpr double least = 1e-4;  // m^2
  const Eigen::Matrix3d& c = graph.covariance();
  const Eigen::LLT<Eigen::Matrix2d> factor(c.topLeftCorner<2, 2>() + least * Eigen::Matrix2d::Identity());
  const Vec2 gap = there.position - graph.keyframes.back().pose.position;
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
  graph.last_constraint().certainty = fit.certainty();
  if (graph.optimise() && graph.chi2() <= most_chi2) return true;
  graph.remove_last_constraint(before);
  return false;
}

}  // namespace

bool LoopSearch::close(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                       std::uint32_t first) {
  constexpr std::size_t least_keyframes = 4;
  if (first > 0 && graph.keyframes.size() - first < least_keyframes) return false;
  const Keyframe& last = graph.keyframes.back();
  if (last.way_m - tried_at_m < try_every_m) return false;
  tried_at_m = last.way_m;
  const Eigen::Matrix3d& c = graph.covariance();
  const double reach_m = std::clamp(reach_sd * std::sqrt(c(0, 0) + c(1, 1)), least_reach_m, most_reach_m);
  const double heading_sd_rad = std::sqrt(c(2, 2));
  const double turn_rad = heading_sd_rad > adrift_rad
                              ? std::numbers::pi
                              : std::clamp(reach_sd * heading_sd_rad, least_turn_rad, most_turn_rad);
  const Surface query = thinned(last_surface(graph, surfaces, first), most_points);
  bool any = false;
  for (const std::uint32_t scan : candidates(graph, reach_m, first)) {
    const Pose2 here = graph.keyframes.back().pose;  // optimisation moves it
    Visit visit = visit_of(graph, scan);
    visit.first = std::max(visit.first, first);
    const auto fit =
        recognise_place(map_of(graph, surfaces, visit), query, {here, reach_m, turn_rad, reach_m, turn_rad});
    if (!fit) continue;
    if (!is_plausible(graph, fit->pose, reach_sd) ||
        is_contradicted(graph, surfaces.robot_T_laser(), visit, first, fit->pose) ||
        !close_loop(graph, scan, *fit)) {
      ++refused;
      continue;
    }
    any = true;
    graph.update_covariance();
    closed.emplace_back(scan, static_cast<std::uint32_t>(graph.keyframes.size() - 1));
  }
  return any;
}

bool LoopSearch::bridge(KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t gap) {
  constexpr double reach_m = 4.0;
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  const Visit before{gap > 2 * visit_keyframes ? gap - 2 * visit_keyframes : 0, gap};
  const Surface query = thinned(last_surface(graph, surfaces, gap), most_points);
  const auto fit = recognise_place(map_of(graph, surfaces, before), query,
                                   {graph.keyframes.back().pose, reach_m, std::numbers::pi});
  if (!fit || is_contradicted(graph, surfaces.robot_T_laser(), before, gap, fit->pose) ||
      !close_loop(graph, gap - 1, *fit))
    return false;
  bridged.emplace_back(gap - 1, last);
  return true;
}

bool LoopSearch::rejoin(KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t gap) {
  constexpr double clear_score = 0.8, least_score = 0.65;  // a high one is found sooner
  constexpr double reach_m = 15.0, widest_m = 250.0;
  constexpr int levels = 8;
  constexpr std::size_t most_keyframes = 12;  // more than for a loop: all places of the map are possible
  if (!is_search_due(graph, gap)) return false;
  const Visit before{0, gap};
  const MatchWindow window = whole_window(graph, before);
  if (window.reach_m > widest_m) return false;
  Surface query = last_surface(graph, surfaces, gap, most_keyframes);
  std::erase_if(query, [](const SurfacePoint& p) { return squared_norm(p.position) > reach_m * reach_m; });
  const SurfaceMap map = map_of(graph, surfaces, before, levels);
  query = thinned(query, most_points);
  auto fit = recognise_place(map, query, window, clear_score);
  if (!fit) fit = recognise_place(map, query, window, least_score);
  if (!fit) return false;
  const std::uint32_t nearest = nearest_in(graph, before, fit->pose.position);
  Visit visit = visit_of(graph, nearest);
  visit.end = std::min(visit.end, gap);
  if (is_contradicted(graph, surfaces.robot_T_laser(), visit, gap, fit->pose) ||
      !close_loop(graph, nearest, *fit)) {
    ++refused;
    return false;
  }
  bridged.emplace_back(nearest, static_cast<std::uint32_t>(graph.keyframes.size() - 1));
  return true;
}

bool LoopSearch::spans(std::uint32_t gap) const {
  const auto around = [&](const auto& pair) { return pair.first < gap && gap <= pair.second; };
  return std::ranges::any_of(closed, around) || std::ranges::any_of(bridged, around);
}

}  // namespace outrider
