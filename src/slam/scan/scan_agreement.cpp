#include "scan/scan_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "outrider/core/units.hpp"
#include "outrider/slam/scan/scan_contradiction.hpp"

namespace outrider {
namespace {

constexpr double off_rad = 0.02;
constexpr std::size_t most_points = 180;
constexpr long most_neighbours = 16;  // beams looked at around a point
constexpr double least_m = 0.5;       // nearer points have too wide a neighbourhood

/// The beams of a scan around a bearing.
struct Neighbourhood {
  double nearest_m = std::numeric_limits<double>::infinity();  ///< of their free parts
  double closest_m = std::numeric_limits<double>::infinity();  ///< least distance of a hit from the range
  bool is_known = false;                                       ///< all of them have a reading
};

/// The beams of a scan by bearing.
class Beams {
 public:
  explicit Beams(const LaserScan& scan)
      : scan_(scan), count_(static_cast<long>(scan.ranges_m.size())), step_(std::abs(scan.step_rad)) {}

  /// Returns what the beams within `aside_rad` of the bearing say about a point at that range.
  [[nodiscard]] Neighbourhood around(double bearing_rad, double range_m, double aside_rad) const {
    Neighbourhood result;
    if (step_ == 0.0) return result;
    const double turned =
        scan_.step_rad > 0.0 ? bearing_rad - scan_.first_rad : scan_.first_rad - bearing_rad;
    const double from = turned - two_pi * std::floor(turned / two_pi);
    const auto low = static_cast<long>(std::floor((from - aside_rad) / step_));
    const auto high = static_cast<long>(std::ceil((from + aside_rad) / step_));
    const bool is_round = static_cast<double>(count_) * step_ >= two_pi - 1.5 * step_;
    if (!is_round && (low < 0 || high >= count_)) return result;
    if (high - low >= count_) return result;
    result.is_known = true;
    const long step = std::max(1L, (high - low) / most_neighbours);
    for (long k = low; k <= high; k += step) include(result, ((k % count_) + count_) % count_, range_m);
    return result;
  }

 private:
  static constexpr double two_pi = 2.0 * std::numbers::pi;

  void include(Neighbourhood& result, long beam, double range_m) const {
    const auto read_m = static_cast<double>(scan_.ranges_m[static_cast<std::size_t>(beam)]);
    if (!(read_m >= scan_.least_m)) {
      result.is_known = false;
      return;
    }
    result.nearest_m = std::min({result.nearest_m, read_m, scan_.most_m});
    if (read_m <= scan_.most_m) result.closest_m = std::min(result.closest_m, std::abs(read_m - range_m));
  }

  const LaserScan& scan_;
  long count_;
  double step_;
};

}  // namespace

Agreement agreement(const LaserScan& of, const Pose2& world_T_of, const LaserScan& by,
                    const Pose2& world_T_by, double off_m) {
  const Pose2 by_T_of = relative_pose(world_T_by, world_T_of);
  const Beams beams(by);
  Agreement result;
  const std::size_t step = std::max<std::size_t>(1, of.ranges_m.size() / most_points);
  for (std::size_t i = 0; i < of.ranges_m.size(); i += step) {
    const auto range_m = static_cast<double>(of.ranges_m[i]);
    if (!(range_m >= of.least_m && range_m <= of.most_m)) continue;
    const Vec2 point = by_T_of * (range_m * direction(of.first_rad + static_cast<double>(i) * of.step_rad));
    const double away_m = norm(point);
    if (away_m < least_m) continue;
    const double margin_m = off_m + off_rad * (away_m + range_m);
    const Neighbourhood seen = beams.around(heading_of(point), away_m, margin_m / away_m);
    if (seen.closest_m <= margin_m) {
      ++result.agreeing;
    } else if (seen.is_known && seen.nearest_m > away_m + margin_m) {
      ++result.seen_through;
    }
  }
  return result;
}

double contradiction(const LaserScan& a, const Pose2& world_T_a, const LaserScan& b, const Pose2& world_T_b) {
  constexpr std::size_t least_points = 40;
  constexpr double off_m = 0.15;
  const Agreement both = mutual_agreement(a, world_T_a, b, world_T_b, off_m);
  return both.seen() < least_points ? 0.0 : both.contradiction();
}

}  // namespace outrider
