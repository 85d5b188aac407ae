#include "laser/local_map.hpp"

#include <algorithm>
#include <cmath>

#include "map/path_check.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t recent_keyframes = 10;
constexpr std::uint32_t earlier = 2 * recent_keyframes;  // keyframes since an earlier visit, at least

/// Returns the keyframes of earlier visits whose pose relative to the last one is well known, ascending.
std::vector<std::uint32_t> known_earlier(const KeyframeGraph& graph) {
  constexpr double most_variance = 0.01;  // m^2
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  std::vector<std::uint32_t> known;
  if (last < earlier) return known;
  const std::vector<double> variance = graph.variances_from(last, most_variance);
  for (std::uint32_t i = 0; i + earlier <= last; ++i) {
    if (variance[i] <= most_variance && graph.keyframes[i].has_scan()) known.push_back(i);
  }
  return known;
}

/// Returns those nearest to a pose, at most 16, nearest first.
std::vector<std::uint32_t> nearest_of(const KeyframeGraph& graph, const std::vector<std::uint32_t>& known,
                                      Vec2 place, double reach_m) {
  constexpr std::size_t most_keyframes = 16;
  std::vector<std::pair<double, std::uint32_t>> nearest;
  for (const std::uint32_t i : known) {
    const double away_m = distance(graph.keyframes[i].pose.position, place);
    if (graph.keyframes[i].has_scan() && away_m <= reach_m) nearest.emplace_back(away_m, i);
  }
  std::sort(nearest.begin(), nearest.end());
  if (nearest.size() > most_keyframes) nearest.resize(most_keyframes);
  std::vector<std::uint32_t> result;
  for (const auto& [away_m, i] : nearest) result.push_back(i);
  return result;
}

/// Releases the scans in the middle of those that were taken from nearly the same pose as the last one, until
/// there are few. Returns true if it released any.
bool release_redundant(KeyframeGraph& graph, const std::vector<std::uint32_t>& known) {
  constexpr double near_m = 0.5, near_rad = 0.35;
  constexpr std::size_t most_views = 16;
  const Pose2& last = graph.keyframes.back().pose;
  std::vector<std::uint32_t> views;
  for (const std::uint32_t i : known) {
    const Pose2& pose = graph.keyframes[i].pose;
    if (distance(pose.position, last.position) <= near_m &&
        std::abs(wrap_angle(pose.heading_rad - last.heading_rad)) <= near_rad)
      views.push_back(i);
  }
  if (views.size() < most_views) return false;
  while (views.size() >= most_views) {
    const auto middle = views.begin() + most_views / 2;
    graph.keyframes[*middle].release_scan();
    views.erase(middle);
  }
  return true;
}

}  // namespace

Matched LocalMap::matched(const KeyframeGraph& graph, std::size_t part) {
  constexpr std::uint32_t lag = 9;
  constexpr double most_share = 0.46;  // at which the mean square of the lags is that of 1 to 10, 38
  const auto last = static_cast<std::uint32_t>(graph.keyframes.size() - 1);
  double share = 0.0;
  if (last >= part + lag) {
    const Pose2 there = relative_pose(graph.keyframes[last - lag].pose, graph.keyframes[last].pose);
    share = most_share * share_on(surfaces_.of(graph, last), there, surfaces_.of(graph, last - lag));
  }
  return {{{last - 1, 1.0 - share}, {last - lag, share}}};
}

void LocalMap::build(KeyframeGraph& graph, std::size_t part, const Pose2& about) {
  constexpr double most_reach_m = 5.0;
  const std::vector<std::uint32_t> known = known_earlier(graph);
  is_crowded_ = release_redundant(graph, known);
  std::vector<SurfaceMap::Part> parts;
  const auto add = [&](std::uint32_t i, int group) {
    parts.push_back({&surfaces_.of(graph, i), graph.keyframes[i].pose, group});
  };
  const std::vector<std::uint32_t> visits =
      nearest_of(graph, known, about.position, std::min(0.5 * reach_m_, most_reach_m));
  anchor_ = visits.empty() ? std::nullopt : std::optional(visits.front());
  for (const std::uint32_t i : visits) add(i, earlier_group);
  const std::size_t count = graph.keyframes.size();
  for (std::size_t i = std::max(part, count > recent_keyframes ? count - recent_keyframes : 0); i < count;
       ++i)
    add(static_cast<std::uint32_t>(i), recent_group);
  map_.emplace(parts);
  surfaces_.forget_unused();
}

}  // namespace outrider
