#include "laser_loops.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double try_every_m = 0.8;
constexpr std::uint32_t query_keys = 6;  // the last scans, taken together
constexpr std::uint32_t visit_keys = 8;  // to both sides of the nearest of an earlier visit
constexpr std::size_t most_points = 600;
constexpr std::size_t most_candidates = 4;
constexpr double near_variance = 0.01;  // m^2; what is known as well needs no search
constexpr double sensed_m = 4.0;        // visits nearer than this see the same

constexpr double sds = 3.0;
constexpr double least_reach_m = 0.5, most_reach_m = 6.0;
constexpr double least_turn_rad = 0.1, most_turn_rad = 0.6;
constexpr double least_score = 0.5;
constexpr double least_share = 0.7;
constexpr double most_rival = 0.85;  // of the score, at a place apart
constexpr double apart_m = 0.8;

/// The last scans in the frame of the last.
Surface last_surface(const KeyGraph& graph) {
  Surface result;
  const std::size_t count = graph.keys.size();
  const Pose2& last = graph.keys.back().pose;
  for (std::size_t i = count > query_keys ? count - query_keys : 0; i < count; ++i) {
    const Pose2 pose = between(last, graph.keys[i].pose);
    for (const SurfacePoint& p : graph.keys[i].surface) {
      result.push_back({composed(pose, {p.position, 0.0}).position, rotated(pose.heading_rad, p.normal)});
    }
  }
  return result;
}

/// The nearest scan of each earlier visit that may be here; of many visits, the nearest ones.
std::vector<std::uint32_t> candidates(const KeyGraph& graph, double uncertain_m) {
  const auto last = static_cast<std::uint32_t>(graph.keys.size() - 1);
  const std::vector<double> known = graph.variances_from(last, near_variance);
  std::vector<std::pair<double, std::uint32_t>> nearest;
  bool open = false;
  for (std::uint32_t i = 0; i < last; ++i) {
    const double away_m = distance(graph.keys[i].pose.position, graph.keys[last].pose.position);
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

/// The surfaces of the visit that has this scan.
SurfaceMap map_of_visit(const KeyGraph& graph, std::uint32_t scan) {
  const auto last = static_cast<std::uint32_t>(graph.keys.size() - 1);
  std::vector<SurfaceMap::Part> parts;
  for (std::uint32_t i = scan > visit_keys ? scan - visit_keys : 0; i <= scan + visit_keys; ++i) {
    if (i + 2 * query_keys < last) parts.push_back({&graph.keys[i].surface, graph.keys[i].pose, 0});
  }
  return SurfaceMap(parts);
}

/// Whether the scan may be there by what is known of it.
bool believable(const KeyScan& scan, const Pose2& there, double reach_sd) {
  constexpr double least = 1e-4;  // m^2
  const Matrix3& c = scan.covariance;
  const auto information = inverse_of_positive(Matrix2{{c(0, 0) + least, c(0, 1), c(1, 0), c(1, 1) + least}});
  const Vec2 off = there.position - scan.pose.position;
  return information && quadratic_form<2>(*information, {off.x, off.y}) <= reach_sd * reach_sd;
}

/// Ties the last scan to that one; undone and false when what is tied already does not give way.
bool tied(KeyGraph& graph, std::uint32_t scan, const Fit& fit) {
  constexpr double most_tension = 100.0;
  const std::vector<Pose2> before = graph.poses();
  graph.tie(scan, static_cast<std::uint32_t>(graph.keys.size() - 1), fit.pose,
            fit.information + diagonal<3>({1.0, 1.0, 1.0}));
  if (graph.relax() && graph.tension() <= most_tension) return true;
  graph.untie(before);
  return false;
}

}  // namespace

std::optional<Fit> recognised(const SurfaceMap& map, const Surface& surface, const MatchWindow& window) {
  const auto found = map.find(surface, window, least_score);
  if (!found) return std::nullopt;
  if (map.may_be_elsewhere(surface, window, most_rival * found->score, found->pose.position, apart_m))
    return std::nullopt;
  constexpr double loose = 100.0;  // 1/m^2: what ten centimetres would say
  const Fit fit = map.refine(surface, found->pose, {found->pose, diagonal<3>({loose, loose, loose})});
  return fit.share >= least_share ? std::optional(fit) : std::nullopt;
}

bool LoopSearch::close(KeyGraph& graph, double reach_sd) {
  const KeyScan& last = graph.keys.back();
  if (last.way_m - tried_at_m < try_every_m) return false;
  tried_at_m = last.way_m;
  const Matrix3& c = last.covariance;
  const double reach_m = std::clamp(sds * std::sqrt(c(0, 0) + c(1, 1)), least_reach_m, most_reach_m);
  const double turn_rad = std::clamp(sds * std::sqrt(c(2, 2)), least_turn_rad, most_turn_rad);
  const Surface query = thinned(last_surface(graph), most_points);
  bool any = false;
  for (const std::uint32_t scan : candidates(graph, reach_m)) {
    const Pose2 here = graph.keys.back().pose;  // relaxing moves it
    const auto fit =
        recognised(map_of_visit(graph, scan), query, {here, reach_m, turn_rad, reach_m, turn_rad});
    if (!fit || !believable(graph.keys.back(), fit->pose, reach_sd) || !tied(graph, scan, *fit)) continue;
    any = true;
    closed.emplace_back(scan, static_cast<std::uint32_t>(graph.keys.size() - 1));
  }
  return any;
}

}  // namespace outrider
