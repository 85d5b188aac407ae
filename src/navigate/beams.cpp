#include "beams.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double turn = 2.0 * pi;
constexpr std::int64_t beams_beside = 1;  // those next to the beam through a mark have to pass it as well

/// Returns the number of a beam that is counted on beyond the first or the last; nothing where no beam is.
std::optional<std::size_t> beam_at(const LaserScan& scan, std::int64_t number) {
  const auto beams = static_cast<std::int64_t>(scan.ranges_m.size());
  const bool whole_turn = static_cast<double>(beams) * scan.step_rad > turn - 0.5 * scan.step_rad;
  const std::int64_t at = whole_turn ? (number + beams) % beams : number;
  if (at < 0 || at >= beams) return {};
  return static_cast<std::size_t>(at);
}

}  // namespace

double range_of(const LaserScan& scan, std::size_t beam) {
  const auto range_m = static_cast<double>(scan.ranges_m[beam]);
  if (std::isnan(range_m) || range_m < scan.least_m) return -1.0;
  return range_m > scan.most_m ? std::numeric_limits<double>::infinity() : range_m;
}

bool passes(const LaserScan& scan, double bearing_rad, double beyond_m) {
  const double ahead = bearing_rad - scan.first_rad;
  const double wrapped = ahead - turn * std::floor(ahead / turn);
  const auto nearest = static_cast<std::int64_t>(std::lround(wrapped / scan.step_rad));
  for (std::int64_t beam = nearest - beams_beside; beam <= nearest + beams_beside; ++beam) {
    const auto at = beam_at(scan, beam);
    if (!at || range_of(scan, *at) <= beyond_m) return false;
  }
  return true;
}

bool has_neighbour(const LaserScan& scan, std::size_t beam, double within_m) {
  const auto is_near = [&](std::int64_t number) {
    const auto at = beam_at(scan, number);
    return at && std::abs(range_of(scan, *at) - range_of(scan, beam)) <= within_m;
  };
  return is_near(static_cast<std::int64_t>(beam) - 1) || is_near(static_cast<std::int64_t>(beam) + 1);
}

}  // namespace outrider
