#include "beams.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double turn = 2.0 * pi;
constexpr std::int64_t few_beams = 2;  // beside each other, of which one as a rule tells a range

/// Returns the number of a beam that is counted on beyond the first or the last; nothing where no beam is.
std::optional<std::size_t> beam_at(const LaserScan& scan, std::int64_t number) {
  const auto beams = static_cast<std::int64_t>(scan.ranges_m.size());
  const std::int64_t at = is_whole_turn(scan) ? (number + beams) % beams : number;
  if (at < 0 || at >= beams) return {};
  return static_cast<std::size_t>(at);
}

/// Returns the number of the beam that would be nearest to a bearing.
std::int64_t number_at(const LaserScan& scan, double bearing_rad) {
  const double ahead = bearing_rad - scan.first_rad;
  return std::lround((ahead - turn * std::floor(ahead / turn)) / scan.step_rad);
}

}  // namespace

double range_of(const LaserScan& scan, std::size_t beam) {
  const auto range_m = static_cast<double>(scan.ranges_m[beam]);
  if (std::isnan(range_m) || range_m < scan.least_m) return -1.0;
  return range_m > scan.most_m ? std::numeric_limits<double>::infinity() : range_m;
}

bool is_whole_turn(const LaserScan& scan) {
  return static_cast<double>(scan.ranges_m.size()) * scan.step_rad > turn - 0.5 * scan.step_rad;
}

bool looks_at(const LaserScan& scan, double bearing_rad) {
  const std::int64_t nearest = number_at(scan, bearing_rad);
  for (std::int64_t beam = nearest - few_beams; beam <= nearest + few_beams; ++beam) {
    const auto at = beam_at(scan, beam);
    if (at && range_of(scan, *at) >= 0.0) return true;
  }
  return false;
}

bool passes(const LaserScan& scan, double bearing_rad, double beyond_m, double beside_rad) {
  const double half = 0.5 * static_cast<double>(scan.ranges_m.size());
  const auto beams_beside =
      static_cast<std::int64_t>(std::max(1.0, std::min(std::ceil(beside_rad / scan.step_rad), half)));
  const std::int64_t nearest = number_at(scan, bearing_rad);
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
