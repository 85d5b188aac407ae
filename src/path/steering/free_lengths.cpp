#include "free_lengths.hpp"

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/motion/turning_path.hpp"

namespace outrider {
namespace {

constexpr int per_radius = 8;
constexpr int reach = 5 * per_radius;
constexpr int side = 2 * reach + 1;
constexpr int headings = 72;

}  // namespace

double FreeLengths::at(const Pose2& pose, bool reverse) {
  const double straight = norm(pose.position);
  const double x = std::round(per_radius * pose.position.x), y = std::round(per_radius * pose.position.y);
  if (!(std::abs(x) <= reach && std::abs(y) <= reach)) return straight;
  const double turn = std::round(wrap_angle(pose.heading_rad) * (headings / (2.0 * pi)));
  const int heading = (static_cast<int>(turn) + headings) % headings;
  std::vector<float>& table = tables_[reverse ? 1 : 0];
  if (table.empty()) table.assign(std::size_t{side} * side * headings, -1.0F);
  const auto row = static_cast<std::size_t>((heading * side + static_cast<int>(y) + reach) * side);
  float& known = table[row + static_cast<std::size_t>(static_cast<int>(x) + reach)];
  if (known < 0.0F) {
    const Pose2 from{{x / per_radius, y / per_radius}, heading * (2.0 * pi / headings)};
    known = static_cast<float>(shortest_turning_length(from, {}, 1.0, reverse));
  }
  return std::max(straight, static_cast<double>(known));
}

}  // namespace outrider
