#include "outrider/slam/map/map_check.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "scan/scan_agreement.hpp"

namespace outrider {
namespace {

constexpr double near_scan_m = 8.0;
constexpr double earlier_m = 5.0;  // driven since an earlier visit
constexpr std::size_t most_visits = 6;
constexpr std::size_t least_points = 40;
constexpr double most_share = 0.5;

/// Returns the nearest scan of each earlier visit of the surroundings of a scan, nearest visit first.
std::vector<std::size_t> earlier_visits(std::span<const PlacedScan> scans, std::size_t of) {
  const PlacedScan& here = scans[of];
  std::vector<std::pair<double, std::size_t>> nearest;
  bool open = false;
  for (std::size_t i = 0; i < of && here.way_m - scans[i].way_m >= earlier_m; ++i) {
    const double away_m = distance(scans[i].world_T_laser.position, here.world_T_laser.position);
    const double turn = wrap_angle(scans[i].world_T_laser.heading_rad - here.world_T_laser.heading_rad);
    const std::pair<double, std::size_t> candidate{away_m + std::abs(turn), i};
    const bool is_near = away_m <= near_scan_m;
    if (is_near && !open) nearest.push_back(candidate);
    if (is_near) nearest.back() = std::min(nearest.back(), candidate);
    open = is_near;
  }
  std::sort(nearest.begin(), nearest.end());
  if (nearest.size() > most_visits) nearest.resize(most_visits);
  std::vector<std::size_t> result;
  for (const auto& [away_m, i] : nearest) result.push_back(i);
  return result;
}

/// Returns the scans with which a scan is compared.
std::vector<std::size_t> partners(std::span<const PlacedScan> scans, std::size_t of) {
  std::vector<std::size_t> result = earlier_visits(scans, of);
  for (const std::size_t back : {1U, 4U}) {
    if (back <= of) result.push_back(of - back);
  }
  return result;
}

}  // namespace

MapCheck check_map(std::span<const PlacedScan> scans) {
  MapCheck result;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    bool is_seen = false;
    Contradiction worst{0, scans[i].pose, 0.0};
    for (const std::size_t k : partners(scans, i)) {
      const Agreement pair =
          mutual_agreement(*scans[i].scan, scans[i].world_T_laser, *scans[k].scan, scans[k].world_T_laser);
      if (pair.seen() < least_points) continue;
      is_seen = true;
      if (pair.contradiction() > worst.share) worst = {scans[k].pose, scans[i].pose, pair.contradiction()};
    }
    result.scans += is_seen ? 1 : 0;
    if (worst.share <= most_share) continue;
    ++result.contradicted;
    result.contradictions.push_back(worst);
  }
  return result;
}

}  // namespace outrider
