#include "laser/place_recognition.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "scan/scan_agreement.hpp"
#include "scan/scan_match.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t query_keyframes = 6;  // the last scans, taken together
constexpr std::uint32_t far_query_keyframes = 40;
constexpr std::uint32_t visit_keyframes = 8;  // to both sides of the nearest keyframe of an earlier visit
constexpr std::size_t most_query_points = 600;

/// Returns the first of so many last keyframes, from `first` on.
std::uint32_t first_of_last(const KeyframeGraph& graph, std::uint32_t first, std::uint32_t most) {
  const auto count = static_cast<std::uint32_t>(graph.keyframes.size());
  return std::max(first, count > most ? count - most : 0);
}

Surface joined_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t first) {
  Surface result;
  const Pose2& last = graph.keyframes.back().pose;
  for (std::uint32_t i = first; i < graph.keyframes.size(); ++i) {
    const Pose2 pose = relative_pose(last, graph.keyframes[i].pose);
    for (const SurfacePoint& p : surfaces.of(graph, i))
      result.push_back({pose * p.position, rotated(pose.heading_rad, p.normal)});
  }
  return thinned(result, most_query_points);
}

/// Returns the keyframe that is nearest to a place, of those that have a scan.
std::uint32_t nearest_of(const KeyframeGraph& graph, std::span<const std::uint32_t> among, Vec2 place) {
  std::uint32_t nearest = among.front();
  double least_m = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : among) {
    const double away_m = distance(graph.keyframes[i].pose.position, place);
    if (!graph.keyframes[i].has_scan() || away_m >= least_m) continue;
    least_m = away_m;
    nearest = i;
  }
  return nearest;
}

}  // namespace

KeyframeRange visit_of(const KeyframeGraph& graph, std::uint32_t keyframe) {
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  constexpr std::uint32_t apart = 2 * query_keyframes;
  return {keyframe > visit_keyframes ? keyframe - visit_keyframes : 0,
          std::min(keyframe + visit_keyframes + 1, last > apart ? last - apart : 0)};
}

SurfaceMap map_of(const KeyframeGraph& graph, KeyframeSurfaces& surfaces,
                  std::span<const std::uint32_t> which, int levels) {
  std::vector<SurfaceMap::Part> parts;
  for (const std::uint32_t i : which) parts.push_back({&surfaces.of(graph, i), graph.keyframes[i].pose, 0});
  return SurfaceMap(parts, levels);
}

SurfaceMap map_of(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, const KeyframeRange& visit) {
  std::vector<std::uint32_t> which(visit.end > visit.first ? visit.end - visit.first : 0);
  std::iota(which.begin(), which.end(), visit.first);
  return map_of(graph, surfaces, which, SurfaceMap::few_levels);
}

Surface last_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t first) {
  return joined_surface(graph, surfaces, first_of_last(graph, first, query_keyframes));
}

bool is_contradicted(const KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframeRange& visit,
                     std::uint32_t first, const Pose2& there) {
  constexpr std::size_t least_points = 40;
  constexpr double most_share = 0.1;
  const Pose2 moved = compose(there, relative_pose(graph.keyframes.back().pose, Pose2{}));
  Agreement sum;
  for (std::uint32_t q = first_of_last(graph, first, query_keyframes); q < graph.keyframes.size(); q += 2) {
    const Pose2 pose = compose(compose(moved, graph.keyframes[q].pose), robot_T_laser);
    for (std::uint32_t v = visit.first; v < visit.end; v += 2) {
      const Keyframe& key = graph.keyframes[v];
      if (key.has_scan())
        sum += mutual_agreement(graph.keyframes[q].scan, pose, key.scan, compose(key.pose, robot_T_laser));
    }
  }
  return sum.seen() >= least_points && sum.contradiction() > most_share;
}

std::optional<KnownPlace> recognise_far(const KeyframeGraph& graph, KeyframeSurfaces& surfaces,
                                        std::span<const std::uint32_t> among, std::uint32_t first,
                                        const MatchWindow& window) {
  constexpr double clear_score = 0.8, least_score = 0.65;  // a high one is found sooner
  constexpr int levels = 7;
  const Surface query = joined_surface(graph, surfaces, first_of_last(graph, first, far_query_keyframes));
  const SurfaceMap map = map_of(graph, surfaces, among, levels);
  auto fit = recognise_place(map, query, window, clear_score);
  if (!fit) fit = recognise_place(map, query, window, least_score);
  if (!fit) return std::nullopt;
  return KnownPlace{nearest_of(graph, among, fit->pose.position), *fit};
}

}  // namespace outrider
