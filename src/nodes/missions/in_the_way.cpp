#include "outrider/nodes/missions/in_the_way.hpp"

#include <algorithm>
#include <cmath>

#include "missions/limits.hpp"

namespace outrider {
namespace {

constexpr double step_m = 0.01;
constexpr int most_steps = 500;
constexpr double nearer_m = 1e-3;  // that count as coming nearer

}  // namespace

StopRule stop_rule(double radius_m, double deceleration_mps2) {
  StopRule rule;
  rule.radius_m = radius_m;
  rule.braking_mps2 = careful * deceleration_mps2;
  return rule;
}

std::optional<Vec2> in_the_way(const std::vector<Vec2>& points, const Pose2& robot, const Twist2& twist,
                               const StopRule& rule) {
  const double speed = speed_of(twist);
  if (!(speed > 0.0)) return std::nullopt;
  const double way_m = std::max(rule.least_m, speed * (rule.reaction_s + speed / rule.braking_mps2));
  const double reach_m = rule.radius_m + rule.gap_m;
  std::vector<Vec2> near;
  std::ranges::copy_if(points, std::back_inserter(near),
                       [&](Vec2 point) { return distance(point, robot.position) < reach_m + way_m; });
  if (near.empty()) return std::nullopt;
  const int steps = std::min(most_steps, static_cast<int>(std::ceil(way_m / step_m)));
  for (int step = 1; step <= steps; ++step) {
    const Pose2 then = moved(robot, twist, way_m / speed * step / steps);
    const auto hit = std::ranges::find_if(near, [&](Vec2 point) {
      const double away_m = distance(point, then.position);
      return away_m < reach_m && away_m < distance(point, robot.position) - nearer_m;
    });
    if (hit != near.end()) return *hit;
  }
  return std::nullopt;
}

}  // namespace outrider
