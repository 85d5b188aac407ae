#include "outrider/navigate/place_search.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr int ways = 32;
constexpr double least_m = 0.5, most_m = 4.0;  // from place to place
constexpr double beside_rad = 0.2;             // a way is as free as the beams so far beside it
constexpr double fresh_weight = 2.0;           // of the distance from other places, against that of the way
constexpr double standing_mps = 0.1;

}  // namespace

void PlaceSearch::begin() { *this = {}; }

void PlaceSearch::look(const LaserScan& scan, const Pose2& world_T_laser) {
  scan_ = scan;
  world_T_laser_ = world_T_laser;
}

void PlaceSearch::advance(double speed_mps, double duration_s) {
  length_m_ += std::max(std::abs(speed_mps), standing_mps) * duration_s;
}

/// Returns how far the beams around a bearing see; nothing of it where the laser does not look.
double PlaceSearch::free_m(double bearing_rad) const {
  double free_m = static_cast<double>(scan_->most_m);
  bool any = false;
  for (std::size_t beam = 0; beam < scan_->ranges_m.size(); ++beam) {
    const double off_rad =
        wrap_angle(scan_->first_rad + static_cast<double>(beam) * scan_->step_rad - bearing_rad);
    const auto range_m = static_cast<double>(scan_->ranges_m[beam]);
    if (std::abs(off_rad) > beside_rad || std::isnan(range_m)) continue;
    free_m = std::min(free_m, range_m);
    any = true;
  }
  return any ? free_m : 0.0;
}

std::optional<Vec2> PlaceSearch::next(Vec2 here, double room_m) {
  visited_.push_back(here);
  if (!scan_) return std::nullopt;
  std::optional<Vec2> best;
  double most = 0.0;
  for (int way = 0; way < ways; ++way) {
    const double bearing_rad = 2.0 * pi * way / ways;
    const double way_m = std::min(free_m(bearing_rad) - room_m, most_m);
    if (way_m < least_m) continue;
    const Vec2 place = world_T_laser_ * (way_m * direction(bearing_rad));
    double fresh_m = most_m;
    for (const Vec2 before : visited_) fresh_m = std::min(fresh_m, distance(before, place));
    const double worth = way_m + fresh_weight * fresh_m;
    if (worth <= most) continue;
    most = worth;
    best = place;
  }
  return best;
}

}  // namespace outrider
