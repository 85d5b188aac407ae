#include "beams.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::int64_t beams_beside = 1;  // those next to the beam through a mark have to pass it as well

}  // namespace

double range_of(const LaserScan& scan, std::size_t beam) {
  const auto range_m = static_cast<double>(scan.ranges_m[beam]);
  if (std::isnan(range_m) || range_m < scan.least_m) return -1.0;
  return range_m > scan.most_m ? std::numeric_limits<double>::infinity() : range_m;
}

bool passes(const LaserScan& scan, double bearing_rad, double beyond_m) {
  const auto beams = static_cast<std::int64_t>(scan.ranges_m.size());
  const double turn = 2.0 * pi;
  const double ahead = bearing_rad - scan.first_rad;
  const double wrapped = ahead - turn * std::floor(ahead / turn);
  const auto nearest = static_cast<std::int64_t>(std::lround(wrapped / scan.step_rad));
  const bool whole_turn = static_cast<double>(beams) * scan.step_rad > turn - 0.5 * scan.step_rad;
  for (std::int64_t beam = nearest - beams_beside; beam <= nearest + beams_beside; ++beam) {
    const std::int64_t at = whole_turn ? (beam + beams) % beams : beam;
    if (at < 0 || at >= beams) return false;
    if (range_of(scan, static_cast<std::size_t>(at)) <= beyond_m) return false;
  }
  return true;
}

}  // namespace outrider
