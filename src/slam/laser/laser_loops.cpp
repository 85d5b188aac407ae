#include "laser/laser_loops.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <set>

#include "algebra/small_cholesky.hpp"
#include "outrider/geometry/box.hpp"
#include "scan/scan_match.hpp"

namespace outrider {
namespace {

constexpr double try_every_m = 0.8;
constexpr std::size_t most_candidates = 4;
constexpr double near_variance = 0.01;  // m^2; a relative pose known this well needs no search
constexpr double sensed_m = 4.0;        // visits nearer than this see the same surroundings

constexpr double least_reach_m = 0.5, most_reach_m = 6.0;  // of a search among single visits
constexpr double widest_m = 250.0;                         // of a search on the whole map
constexpr double recent_m = 60.0;  // of way; in a wide window, older visits are searched all together
constexpr double least_turn_rad = 0.1, most_turn_rad = 0.6;
constexpr double most_chi2 = 100.0;  // r^T W r of a loop; beyond it, the other constraints contradict it
constexpr std::size_t most_rivals = 16;
constexpr double adrift_rad = 0.7;  // standard deviation of a heading from which the full turn is searched

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

/// Returns the first keyframe of the last `recent_m`.
std::uint32_t first_recent(const KeyframeGraph& graph) {
  const double from_m = graph.keyframes.back().way_m - recent_m;
  const auto first = std::ranges::lower_bound(graph.keyframes, from_m, {}, &Keyframe::way_m);
  return static_cast<std::uint32_t>(first - graph.keyframes.begin());
}

/// Returns the keyframes from `first` to before `end` that lie within a distance of the last one.
std::vector<std::uint32_t> keyframes_within(const KeyframeGraph& graph, double reach_m, std::uint32_t first,
                                            std::uint32_t end) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = first; i < end; ++i) {
    const double away_m = distance(graph.keyframes[i].pose.position, graph.keyframes.back().pose.position);
    if (graph.keyframes[i].has_scan() && away_m <= reach_m) result.push_back(i);
  }
  return result;
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

/// Returns the window that holds all places of the keyframes before one, in the full turn.
MatchWindow whole_window(const KeyframeGraph& graph, std::uint32_t end) {
  constexpr double margin_m = 2.0;
  Box2 box;
  for (std::uint32_t i = 0; i < end; ++i) box.include(graph.keyframes[i].pose.position);
  const Vec2 size = box.size();
  return {{0.5 * (box.low + box.high), 0.0}, 0.5 * std::max(size.x, size.y) + margin_m, std::numbers::pi};
}

/// Returns true if position and heading lie within `reach_sd` standard deviations of those that the last
/// keyframe is believed to have.
bool is_plausible(const KeyframeGraph& graph, const Pose2& there, double reach_sd) {
  constexpr double least = 1e-4;  // m^2
  const Eigen::Matrix3d& c = graph.covariance();
  const double turn_rad = std::abs(wrap_angle(there.heading_rad - graph.keyframes.back().pose.heading_rad));
  if (turn_rad > std::max(least_turn_rad, reach_sd * std::sqrt(c(2, 2)))) return false;
  const SmallCholesky<2> factor(c.topLeftCorner<2, 2>() + least * Eigen::Matrix2d::Identity());
  const Vec2 gap = there.position - graph.keyframes.back().pose.position;
  const Eigen::Vector2d off(gap.x, gap.y);
  return factor.is_positive() && off.dot(factor.solve(off)) <= reach_sd * reach_sd;
}

/// Returns the constraint of a match of `scan` with the last keyframe.
KeyframeConstraint loop_constraint(const KeyframeGraph& graph, std::uint32_t scan, const Fit& fit) {
  const Pose2& from = graph.keyframes[scan].pose;
  KeyframeConstraint result;
  result.edge = {EdgeKind::pose, scan, static_cast<std::uint32_t>(graph.keyframes.size() - 1),
                 relative_pose(from, fit.pose),
                 in_frame(fit.information + Eigen::Matrix3d::Identity(), from.heading_rad)};
  result.certainty = fit.certainty();
  return result;
}

/// Adds a constraint and optimises. Undoes both and returns false if the other constraints contradict it.
bool add_loop(KeyframeGraph& graph, const KeyframeConstraint& loop) {
  const std::vector<Pose2> before = graph.poses();
  graph.add_constraint(loop);
  if (graph.optimise() && graph.chi2() <= most_chi2) return true;
  graph.remove_last_constraint(before);
  return false;
}

}  // namespace

bool LoopSearch::believe(KeyframeGraph& graph, const Pose2& robot_T_laser, const KnownPlace& place,
                         const KeyframeRange& visit, std::uint32_t first) {
  if (was_undone(graph, place.keyframe) ||
      is_contradicted(graph, robot_T_laser, visit, first, place.fit.pose)) {
    ++refused;
    return false;
  }
  const KeyframeConstraint loop = loop_constraint(graph, place.keyframe, place.fit);
  if (add_loop(graph, loop)) return true;
  ++refused;
  ++rivals_found;
  rivals.push_back(loop);
  if (rivals.size() > most_rivals) rivals.erase(rivals.begin());
  return false;
}

bool LoopSearch::review(KeyframeGraph& graph, const Pose2& robot_T_laser) {
  constexpr std::uint32_t later_keyframes = 12;
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  bool any = false;
  for (const KeyframePair& loop : std::vector(closed)) {
    const bool is_due = loop.second + later_keyframes == last && std::ranges::count(closed, loop) > 0;
    if (!is_due || !is_contradicted_since(graph, robot_T_laser, loop)) continue;
    if (undo_loop(graph, robot_T_laser, loop)) any = drop_removed(graph) || any;
  }
  if (!rivals.empty() && rivals_found >= rivals_due) {
    rivals_due = 2 * rivals_found;
    any = weigh_rivals(graph) || any;
  }
  if (any) graph.update_covariance();
  return any;
}

bool LoopSearch::drop_removed(const KeyframeGraph& graph) {
  std::set<KeyframePair> joined;
  for (const KeyframeConstraint& constraint : graph.constraints())
    joined.emplace(constraint.edge.from, constraint.edge.to);
  const auto is_removed = [&](const KeyframePair& loop) { return !joined.contains(loop); };
  const auto removed = std::ranges::stable_partition(closed, std::not_fn(is_removed));
  undone.insert(undone.end(), removed.begin(), removed.end());
  const bool any = !removed.empty();
  closed.erase(removed.begin(), removed.end());
  if (any) std::erase_if(bridged, is_removed);
  return any;
}

bool LoopSearch::weigh_rivals(KeyframeGraph& graph) {
  const std::vector<KeyframeConstraint> before = graph.constraints();
  const std::vector<Pose2> poses = graph.poses();
  const auto kept = reconciled(graph, rivals, most_chi2);
  if (!kept) return false;
  const auto pair_of = [](const KeyframeConstraint& c) { return KeyframePair{c.edge.from, c.edge.to}; };
  graph.replace(*kept, poses);
  std::vector<KeyframePair> accepted;
  for (const KeyframeConstraint& rival : rivals) {
    if (add_loop(graph, rival)) accepted.push_back(pair_of(rival));
  }
  if (accepted.empty() || !drop_removed(graph)) {
    graph.replace(before, poses);
    return false;
  }
  closed.insert(closed.end(), accepted.begin(), accepted.end());
  std::erase_if(rivals, [&](const auto& rival) { return std::ranges::count(accepted, pair_of(rival)) > 0; });
  return true;
}

bool LoopSearch::was_undone(const KeyframeGraph& graph, std::uint32_t keyframe) const {
  constexpr std::uint32_t near_keyframes = 24;
  constexpr double near_m = 30.0;  // of way
  const double way_m = graph.keyframes.back().way_m;
  return std::ranges::any_of(undone, [&](const KeyframePair& loop) {
    const auto [low, high] = std::minmax(loop.first, keyframe);
    return high - low <= near_keyframes && way_m - graph.keyframes[loop.second].way_m <= near_m;
  });
}

bool LoopSearch::close(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                       std::uint32_t first) {
  constexpr std::size_t least_keyframes = 4;
  if (first > 0 && graph.keyframes.size() - first < least_keyframes) return false;
  const Keyframe& last = graph.keyframes.back();
  if (last.way_m - tried_at_m < try_every_m) return false;
  tried_at_m = last.way_m;
  const Eigen::Matrix3d& c = graph.covariance();
  const double reach_m = std::max(least_reach_m, reach_sd * std::sqrt(c(0, 0) + c(1, 1)));
  const double heading_sd_rad = std::sqrt(c(2, 2));
  const double turn_rad = std::clamp(reach_sd * heading_sd_rad, least_turn_rad, std::numbers::pi);
  MatchWindow window{graph.keyframes.back().pose, reach_m, turn_rad, reach_m, turn_rad};
  const bool is_wide = reach_m > most_reach_m;
  const std::uint32_t recent = is_wide ? std::max(first, first_recent(graph)) : first;
  if (is_wide && close_far(graph, surfaces, reach_sd, {first, recent}, window)) return true;
  window.reach_m = window.position_sd_m = std::min(reach_m, most_reach_m);
  if (heading_sd_rad <= adrift_rad)
    window.turn_rad = window.heading_sd_rad = std::min(turn_rad, most_turn_rad);
  return close_near(graph, surfaces, reach_sd, recent, window);
}

bool LoopSearch::close_near(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                            std::uint32_t first, MatchWindow window) {
  const Surface query = last_surface(graph, surfaces, first);
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  bool any = false;
  for (const std::uint32_t scan : candidates(graph, window.reach_m, first)) {
    window.centre = graph.keyframes.back().pose;  // optimisation moves it
    KeyframeRange visit = visit_of(graph, scan);
    visit.first = std::max(visit.first, first);
    const auto fit = recognise_place(map_of(graph, surfaces, visit), query, window);
    if (!fit) continue;
    if (!is_plausible(graph, fit->pose, reach_sd)) {
      ++refused;
      continue;
    }
    if (!believe(graph, surfaces.robot_T_laser(), {scan, *fit}, visit, first)) continue;
    any = true;
    graph.update_covariance();
    closed.emplace_back(scan, last);
  }
  return any;
}

bool LoopSearch::close_far(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                           const KeyframeRange& earlier, const MatchWindow& window) {
  constexpr double first_m = 5.0, growth = 1.5, most_m = 50.0;
  const double way_m = graph.keyframes.back().way_m;
  if (window.reach_m > widest_m || way_m < far_due_at_m) return false;
  const std::vector<std::uint32_t> among =
      keyframes_within(graph, window.reach_m + sensed_m, earlier.first, earlier.end);
  if (among.empty()) return false;
  const auto place = recognise_far(graph, surfaces, among, earlier.end, window);
  const bool plausible = place && is_plausible(graph, place->fit.pose, reach_sd);
  if (place && !plausible) ++refused;
  if (plausible &&
      believe(graph, surfaces.robot_T_laser(), *place, visit_of(graph, place->keyframe), earlier.end)) {
    closed.emplace_back(place->keyframe, static_cast<std::uint32_t>(graph.keyframes.size() - 1));
    graph.update_covariance();
    far_every_m = 0.0;
    return true;
  }
  far_every_m = std::clamp(growth * far_every_m, first_m, most_m);
  far_due_at_m = way_m + far_every_m;
  return false;
}

bool LoopSearch::bridge(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                        std::uint32_t gap) {
  constexpr double reach_m = 4.0;
  constexpr std::uint32_t most_keyframes = 16;
  if (!bridging.take_occasion()) return false;
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  const KeyframeRange before{gap > most_keyframes ? gap - most_keyframes : 0, gap};
  const auto fit = recognise_place(map_of(graph, surfaces, before), last_surface(graph, surfaces, gap),
                                   {graph.keyframes.back().pose, reach_m, std::numbers::pi});
  const bool joined = fit && is_plausible(graph, fit->pose, reach_sd) &&
                      !is_contradicted(graph, surfaces.robot_T_laser(), before, gap, fit->pose) &&
                      add_loop(graph, loop_constraint(graph, gap - 1, *fit));
  bridging.note(joined);
  if (joined) bridged.emplace_back(gap - 1, last);
  return joined;
}

bool LoopSearch::rejoin(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                        std::uint32_t gap) {
  if (!is_search_due(graph, gap)) return false;
  const MatchWindow window = whole_window(graph, gap);
  if (window.reach_m > widest_m || !rejoining.take_occasion()) return false;
  std::vector<std::uint32_t> before(gap);
  std::iota(before.begin(), before.end(), 0U);
  const auto place = recognise_far(graph, surfaces, before, gap, window);
  const auto is_believed = [&] {
    KeyframeRange visit = visit_of(graph, place->keyframe);
    visit.end = std::min(visit.end, gap);
    return believe(graph, surfaces.robot_T_laser(), *place, visit, gap);
  };
  const bool joined = place && is_plausible(graph, place->fit.pose, reach_sd) && is_believed();
  rejoining.note(joined);
  if (!joined) return false;
  bridged.emplace_back(place->keyframe, static_cast<std::uint32_t>(graph.keyframes.size() - 1));
  return true;
}

bool LoopSearch::spans(std::uint32_t gap) const {
  const auto around = [&](const auto& pair) { return pair.first < gap && gap <= pair.second; };
  return std::ranges::any_of(closed, around) || std::ranges::any_of(bridged, around);
}

std::vector<std::uint32_t> LoopSearch::open_gaps(std::span<const std::uint32_t> gaps) const {
  std::vector<std::size_t> joined(gaps.size() + 1);  // by part of the map: a part that it is joined with
  std::iota(joined.begin(), joined.end(), std::size_t{0});
  const auto root = [&](std::size_t part) {
    while (joined[part] != part) part = joined[part];
    return part;
  };
  const auto part_of = [&](std::uint32_t keyframe) {
    return static_cast<std::size_t>(std::ranges::upper_bound(gaps, keyframe) - gaps.begin());
  };
  for (const auto& pairs : {closed, bridged}) {
    for (const auto& [earlier, later] : pairs) joined[root(part_of(later))] = root(part_of(earlier));
  }
  std::vector<std::uint32_t> open;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (root(i) != root(i + 1)) open.push_back(gaps[i]);
  }
  return open;
}

}  // namespace outrider
