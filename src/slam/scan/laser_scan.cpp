#include "outrider/slam/scan/laser_scan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "outrider/core/text.hpp"

namespace outrider {

Status check(const LaserScan& scan) {
  constexpr std::size_t most_beams = 100'000;
  if (scan.ranges_m.empty() || scan.ranges_m.size() > most_beams) {
    return bad_input(fmt::format("a scan of {} beams; expected 1 to {}", scan.ranges_m.size(), most_beams));
  }
  if (!std::isfinite(scan.time_s)) return bad_input("the time of a scan is not finite; leave the scan out");
  const double turn = std::abs(scan.step_rad);
  if (!(std::abs(scan.first_rad) <= 1e6) || !(turn <= 2.0 * std::numbers::pi)) {
    return bad_input(fmt::format("beams from {} rad by {} rad; a step is at most a turn",
                                 short_number(scan.first_rad), short_number(scan.step_rad)));
  }
  if (!(scan.least_m >= 0.0) || !(scan.most_m > scan.least_m) || !(scan.most_m <= 1e6)) {
    return bad_input(fmt::format("ranges from {} to {} m; expected 0 <= least < most <= 1e6",
                                 short_number(scan.least_m), short_number(scan.most_m)));
  }
  return {};
}

}  // namespace outrider
