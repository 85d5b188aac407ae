#include "outrider/slam/map_error.hpp"

#include <cmath>

#include "graph/graph_edges.hpp"

namespace outrider {
namespace {

Vec2 mean(const std::vector<Vec2>& points) {
  Vec2 sum;
  for (const Vec2 p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

constexpr std::size_t nobody = static_cast<std::size_t>(-1);

/// Returns for each place the nearest landmark within reach that is not assigned to an earlier place, or
/// nobody.
std::vector<std::size_t> partners(const LandmarkMap& map, const std::vector<Vec2>& places,
                                  const Pose2& motion, double reach_m) {
  std::vector<std::size_t> result;
  std::vector<bool> taken(map.size(), false);
  for (const Vec2 place : places) {
    std::size_t best = nobody;
    double least_m = reach_m;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const double apart = distance(motion * map[i].position, place);
      if (taken[i] || apart >= least_m) continue;
      least_m = apart;
      best = i;
    }
    if (best != nobody) taken[best] = true;
    result.push_back(best);
  }
  return result;
}

MapError error_of(const LandmarkMap& map, const std::vector<Vec2>& places,
                  const std::vector<std::size_t>& pairs) {
  std::vector<Vec2> estimates, matched;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (pairs[i] == nobody) continue;
    estimates.push_back(map[pairs[i]].position);
    matched.push_back(places[i]);
  }
  const Pose2 alignment = rigid_alignment(estimates, matched);
  return {estimates.size(), rms_distance(estimates, matched), rms_distance(estimates, matched, alignment),
          alignment};
}

}  // namespace

Pose2 rigid_alignment(const std::vector<Vec2>& estimate, const std::vector<Vec2>& truth) {
  if (estimate.empty()) return {};
  const Vec2 from = mean(estimate), to = mean(truth);
  double along = 0.0, across = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    along += dot(estimate[i] - from, truth[i] - to);
    across += cross(estimate[i] - from, truth[i] - to);
  }
  const double heading_rad = std::atan2(across, along);
  return {to - rotated(heading_rad, from), heading_rad};
}

std::optional<double> rms_distance(const std::vector<Vec2>& estimate, const std::vector<Vec2>& truth,
                                   const Pose2& motion) {
  if (estimate.empty()) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    sum += squared_norm(motion * estimate[i] - truth[i]);
  }
  return std::sqrt(sum / static_cast<double>(estimate.size()));
}

MapError map_error(const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth) {
  std::vector<Vec2> estimates, places;
  for (const LandmarkEstimate& landmark : map) {
    const auto found = truth.find(landmark.id);
    if (found == truth.end()) continue;
    estimates.push_back(landmark.position);
    places.push_back(found->second);
  }
  const Pose2 alignment = rigid_alignment(estimates, places);
  return {estimates.size(), rms_distance(estimates, places), rms_distance(estimates, places, alignment),
          alignment};
}

MapError map_error_by_place(const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth,
                            double reach_m) {
  std::vector<Vec2> places;
  for (const auto& [id, place] : truth) places.push_back(place);
  MapError best;
  for (std::size_t a = 0; a < map.size(); ++a) {
    for (std::size_t b = 0; b < map.size(); ++b) {
      const double apart = distance(map[a].position, map[b].position);
      for (std::size_t c = 0; a != b && c < places.size(); ++c) {
        for (std::size_t d = 0; d < places.size(); ++d) {
          if (c == d || std::abs(distance(places[c], places[d]) - apart) > reach_m) continue;
          const Pose2 motion = rigid_alignment({map[a].position, map[b].position}, {places[c], places[d]});
          const MapError found = error_of(map, places, partners(map, places, motion, reach_m));
          const bool better =
              found.landmarks > best.landmarks ||
              (found.landmarks == best.landmarks && found.aligned_rmse_m < best.aligned_rmse_m);
          if (better) best = found;
        }
      }
    }
  }
  return best;
}

std::optional<std::pair<std::int64_t, std::int64_t>> exchanged_ids(
    const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth) {
  double least = 0.25 * map_error(map, truth).aligned_rmse_m.value_or(0.0);
  std::optional<std::pair<std::int64_t, std::int64_t>> best;
  for (auto a = truth.begin(); a != truth.end(); ++a) {
    for (auto b = std::next(a); b != truth.end(); ++b) {
      auto exchanged = truth;
      std::swap(exchanged[a->first], exchanged[b->first]);
      const auto error = map_error(map, exchanged).aligned_rmse_m;
      if (!error || *error > least) continue;
      least = *error;
      best = {a->first, b->first};
    }
  }
  return best;
}

}  // namespace outrider
