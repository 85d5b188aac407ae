#include "ground/bar_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider::cover {
namespace {

constexpr double straight_rad = 1e-9;  // less is no turn

/// Returns the centre of the rotation that takes one pose to the other.
Vec2 centre_of(const Pose2& from, const Pose2& to) {
  const Vec2 way = to.position - from.position;
  const double half_rad = 0.5 * (to.heading_rad - from.heading_rad);
  return from.position + 0.5 * way + (0.5 / std::tan(half_rad)) * perpendicular(way);
}

/// Adds what a part of an edge passes over; its distance from the centre grows from `near` to `far`.
void add_part(Vec2 centre, Vec2 near, Vec2 far, double angle_rad, Approximation how, Region& swept) {
  const Vec2 inner = near - centre, outer = far - centre;
  const double stretch = 1.0 / std::cos(0.5 * angle_rad);
  std::vector<Vec2> outline{near, far};
  if (how == Approximation::around) outline.push_back(centre + stretch * rotated(0.5 * angle_rad, outer));
  outline.push_back(centre + rotated(angle_rad, outer));
  outline.push_back(centre + rotated(angle_rad, inner));
  if (how == Approximation::inside) {
    if (norm(inner) * stretch * stretch >= norm(outer)) return;  // nothing between tangent and chord
    outline.push_back(centre + stretch * rotated(0.5 * angle_rad, inner));
  }
  swept.push_back({std::move(outline), {}});
}

void add_edge(Vec2 centre, Vec2 a, Vec2 b, double angle_rad, Approximation how, Region& swept) {
  const Vec2 along = b - a;
  const double foot = dot(centre - a, along) / dot(along, along);
  const Vec2 nearest = a + std::clamp(foot, 0.0, 1.0) * along;
  if (foot > 0.0) add_part(centre, nearest, a, angle_rad, how, swept);
  if (foot < 1.0) add_part(centre, nearest, b, angle_rad, how, swept);
}

}  // namespace

std::vector<Vec2> outline_of(const Bar& bar, const Pose2& pose) {
  const Vec2 ahead = direction(pose.heading_rad), aside = perpendicular(ahead);
  const double rear = bar.forward_m - 0.5 * bar.length_m, front = bar.forward_m + 0.5 * bar.length_m;
  const auto corner = [&](double x, double side) {
    return pose.position + x * ahead + (side * 0.5 * bar.width_m) * aside;
  };
  return {corner(rear, -1.0), corner(front, -1.0), corner(front, 1.0), corner(rear, 1.0)};
}

Region bar_sweep(const Pose2& from, const Pose2& to, const Bar& bar, Approximation how) {
  const std::vector<Vec2> first = outline_of(bar, from), last = outline_of(bar, to);
  const double angle = to.heading_rad - from.heading_rad;
  if (std::abs(angle) <= straight_rad) {
    std::vector<Vec2> both = first;
    both.insert(both.end(), last.begin(), last.end());
    return {{convex_hull(std::move(both)), {}}};
  }
  Region swept{{first, {}}, {last, {}}};
  const Vec2 centre = centre_of(from, to);
  for (std::size_t i = 0; i < first.size(); ++i)
    add_edge(centre, first[i], first[(i + 1) % first.size()], angle, how, swept);
  return united(std::vector<Region>{swept});
}

std::vector<Pose2> with_small_turns(const std::vector<Pose2>& poses) {
  std::vector<Pose2> all;
  for (const Pose2& to : poses) {
    const double angle = all.empty() ? 0.0 : to.heading_rad - all.back().heading_rad;
    const int steps = static_cast<int>(std::ceil(std::abs(angle) / sweep_step_rad));
    if (steps > 1) {
      const Pose2 from = all.back();
      const Vec2 centre = centre_of(from, to);
      for (int i = 1; i < steps; ++i) {
        const double part = angle * i / steps;
        all.push_back({centre + rotated(part, from.position - centre), from.heading_rad + part});
      }
    }
    all.push_back(to);
  }
  return all;
}

}  // namespace outrider::cover
