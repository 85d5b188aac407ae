#include "outrider/motion/twist.hpp"

#include <cmath>

namespace outrider {
namespace {

/// Holds sin(a) / a and (1 - cos(a)) / a; computed by series near 0, where the quotients lose digits.
struct ArcFactors {
  double along;
  double aside;
};
ArcFactors arc_factors(double angle_rad) {
  constexpr double small_rad = 1e-4;
  if (std::abs(angle_rad) < small_rad) {
    return {1.0 - angle_rad * angle_rad / 6.0, angle_rad / 2.0};  // next terms: below 1e-17 and 1e-13
  }
  const double half = std::sin(0.5 * angle_rad);
  return {std::sin(angle_rad) / angle_rad, 2.0 * half * half / angle_rad};
}

}  // namespace

Pose2 moved(const Pose2& from, const Twist2& twist, double duration_s) {
  const double turn = twist.turn_radps * duration_s;
  const auto [along, aside] = arc_factors(turn);
  const Vec2 v = duration_s * Vec2{twist.ahead_mps, twist.left_mps};
  return compose(from, {{along * v.x - aside * v.y, aside * v.x + along * v.y}, turn});
}

Twist2 twist_between(const Pose2& from, const Pose2& to, double duration_s) {
  const double turn = to.heading_rad - from.heading_rad;
  const auto [along, aside] = arc_factors(turn);
  const double scale = 1.0 / ((along * along + aside * aside) * duration_s);
  const Vec2 p = from.to_local(to.position);
  return {scale * (along * p.x + aside * p.y), scale * (along * p.y - aside * p.x), turn / duration_s};
}

}  // namespace outrider
