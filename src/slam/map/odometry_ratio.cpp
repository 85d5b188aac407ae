#include "outrider/slam/map/odometry_ratio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace outrider {
namespace {

constexpr double part_m = 1.0, part_rad = 1.0;
constexpr double most_off = 0.03;  // of the size of the map
constexpr double sds = 2.0;

/// Returns the mean of the middle three fifths, with its standard deviation after Tukey and McLaughlin.
MotionRatio ratio_of(std::vector<double> parts) {
  constexpr std::size_t least_parts = 10;
  const std::size_t count = parts.size(), cut = count / 5;
  if (count < least_parts) return {};
  std::ranges::sort(parts);
  const auto kept = static_cast<double>(count - 2 * cut);
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = cut; i < count - cut; ++i) sum += parts[i];
  const double value = sum / kept;
  const double low = parts[cut], high = parts[count - cut - 1];  // for all that lie beyond
  const double mean = (sum + static_cast<double>(cut) * (low + high)) / static_cast<double>(count);
  for (const double part : parts) squares += std::pow(std::clamp(part, low, high) - mean, 2);
  const double share = kept / static_cast<double>(count);
  return {value, std::sqrt(squares / static_cast<double>((count - 1) * count)) / share};
}

}  // namespace

OdometryRatio compare_with_odometry(std::span<const CountedStep> steps) {
  std::vector<double> ways, turns;
  Pose2 counted, mapped;
  double way_m = 0.0, counted_rad = 0.0, mapped_rad = 0.0, turn_rad = 0.0;
  for (const CountedStep& step : steps) {
    counted = compose(counted, step.by_odometry);
    mapped = compose(mapped, step.by_map);
    way_m += norm(step.by_odometry.position);
    counted_rad += step.by_odometry.heading_rad;
    mapped_rad += step.by_map.heading_rad;
    turn_rad += std::abs(step.by_odometry.heading_rad);
    if (way_m >= part_m) {
      const double straight_m = norm(counted.position);
      if (straight_m >= 0.5 * part_m) ways.push_back(norm(mapped.position) / straight_m);
      way_m = 0.0;
      counted = mapped = {};
    }
    if (turn_rad >= part_rad) {
      if (std::abs(counted_rad) >= 0.5 * part_rad) turns.push_back(mapped_rad / counted_rad);
      turn_rad = counted_rad = mapped_rad = 0.0;
    }
  }
  return {ratio_of(std::move(ways)), ratio_of(std::move(turns))};
}

std::string why_not_believed(const OdometryRatio& ratio) {
  const auto& [ways, turns] = ratio;
  const double size = ways.value / turns.value;
  if (!(std::abs(size - 1.0) > std::max(most_off, sds * std::hypot(ways.sd, turns.sd)))) return {};
  const auto text = [](double value) {
    return fmt::format("{:.1f} % {}", 100.0 * std::abs(value - 1.0), value > 1.0 ? "more" : "less");
  };
  return fmt::format(
      "the map moves {} than the wheels counted and turns {}, so ranges may be {:.0f} % too {} and the map "
      "of that wrong size, or the wheels are farther apart or nearer than told",
      text(ways.value), text(turns.value), 100.0 * std::abs(size - 1.0), size > 1.0 ? "long" : "short");
}

}  // namespace outrider
