#include "outrider/ballistics/sight.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Corners of the target's footprint with its sides moved out by `by_m`.
std::vector<Vec2> ground_box(const Target& target, double by_m) {
  const Vec2 x = (0.5 * target.size.x + by_m) * direction(target.yaw_rad);
  const Vec2 y = (0.5 * target.size.y + by_m) * perpendicular(direction(target.yaw_rad));
  const Vec2 c = xy(target.base);
  return {c - x - y, c + x - y, c + x + y, c - x + y};
}

}  // namespace

std::optional<Arc> Sight::arc(double pitch_rad, Vec2 tip, double tangent, double cosine,
                              double aim_z_m) const {
  const double s = aim_m - tip.x;
  if (s <= 0.0) return std::nullopt;
  const double height = rules->floor_z_m + tip.y;
  const double fall = height + s * tangent - aim_z_m;
  if (fall <= 0.0) return std::nullopt;
  const double drop = fall / (s * s);
  const double forward = std::sqrt(rules->gravity_mps2 / (2.0 * drop));
  const double speed = forward / cosine;
  if (speed > rules->gun.muzzle_speed_mps) return std::nullopt;
  return Arc{{0.0, pitch_rad, speed}, tip.x, height, tangent, drop, forward};
}

const Blocker* Sight::stopped_by(const Arc& arc) const {
  const double grow = rules->gun.ball_radius_m + rules->margin_m;
  const double z_entry = arc.z(entry_m);
  const bool by_the_side = z_entry >= target->base.z && z_entry <= target->base.z + target->size.z;
  const double end = by_the_side ? entry_m : aim_m;
  for (const Window& window : windows) {
    const Blocker& blocker = *window.blocker;
    const double from = std::max(window.grown.low, arc.start_m);
    const double to = std::min(window.grown.high, end);
    if (from > to) continue;
    if (std::min(arc.z(from), arc.z(to)) > blocker.high_m + grow) continue;
    if (arc.highest(from, to) < blocker.low_m - grow) continue;
    const double middle = 0.5 * (window.core.low + window.core.high);
    const double z_middle = arc.z(middle);
    if (window.core.low <= window.core.high && middle >= arc.start_m && middle < touch_m &&
        z_middle >= blocker.low_m && z_middle <= blocker.high_m) {
      return &blocker;
    }
    const Shot shot{heading_of(along), arc.shot.pitch_rad, arc.shot.speed_mps};
    const Flight flight = launch(rules->gun, position, rules->floor_z_m, shot, rules->gravity_mps2);
    const auto touch = contact_time(flight, grow, blocker.piece, arc.time(from), arc.time(to));
    if (!touch) continue;
    if (arc.start_m + *touch * arc.forward_mps >= touch_m &&
        contact_time(flight, rules->gun.ball_radius_m, solid_of(*target), 0.0, *touch)) {
      continue;  // the target is touched first
    }
    return &blocker;
  }
  return nullptr;
}

std::vector<double> offsets(double low, double high, double step) {
  const int below = static_cast<int>(std::ceil(-low / step - 1e-9));
  const int above = static_cast<int>(std::ceil(high / step - 1e-9));
  std::vector<double> result;
  for (int i = below; i > 0; --i) result.push_back(low * i / below);
  result.push_back(0.0);
  for (int i = 1; i <= above; ++i) result.push_back(high * i / above);
  return result;
}

std::vector<Vec2> aim_points(const Target& target, Vec2 position, double step_m) {
  const Vec2 to_centre = xy(target.base) - position;
  const double range = norm(to_centre);
  if (range == 0.0) return {};
  const auto footprint = ground_box(target, 0.0);
  double right = 0.0;
  double left = 0.0;
  double farthest = 0.0;
  for (const Vec2 corner : footprint) {
    const Vec2 ray = corner - position;
    const double bearing = std::atan2(cross(to_centre, ray), dot(to_centre, ray));
    right = std::min(right, bearing);
    left = std::max(left, bearing);
    farthest = std::max(farthest, norm(ray));
  }
  std::vector<Vec2> points;
  for (const double bearing : offsets(right, left, step_m / farthest)) {
    const Vec2 along = direction(heading_of(to_centre) + bearing);
    const auto chord = cut(footprint, position, along, 0.0, farthest);
    if (chord) points.push_back(position + 0.5 * (chord->low + chord->high) * along);
  }
  return points;
}

void look(Sight& sight, const ShotRules& rules, const Target& target, Vec2 position, Vec2 aim,
          const std::vector<const Blocker*>& near) {
  const Vec2 line = aim - position;
  sight.rules = &rules;
  sight.target = &target;
  sight.position = position;
  sight.aim_m = norm(line);
  sight.along = 1.0 / sight.aim_m * line;
  const auto inside = cut(ground_box(target, 0.0), position, sight.along, 0.0, sight.aim_m);
  const double reach = rules.gun.ball_radius_m + contact_tolerance_m;
  const auto near_it = cut(ground_box(target, reach), position, sight.along, 0.0, sight.aim_m);
  sight.entry_m = inside ? inside->low : sight.aim_m;
  sight.touch_m = near_it ? near_it->low : sight.entry_m;
  sight.windows.clear();
  for (const Blocker* blocker : near) {
    if (blocker->hull.empty()) {
      sight.windows.push_back({blocker, {0.0, sight.aim_m}, {1.0, 0.0}});
      continue;
    }
    const auto grown = cut(blocker->hull, position, sight.along, 0.0, sight.aim_m);
    if (!grown) continue;
    const auto core =
        blocker->core.empty() ? std::nullopt : cut(blocker->core, position, sight.along, 0.0, sight.aim_m);
    sight.windows.push_back({blocker, *grown, core.value_or(Interval{1.0, 0.0})});
  }
}

double longest_range(const ShotRules& rules, const Target& target) {
  const double speed2 = rules.gun.muzzle_speed_mps * rules.gun.muzzle_speed_mps;
  const double g = rules.gravity_mps2;
  const double tip = std::hypot(rules.gun.tip_forward_m, rules.gun.tip_up_m);
  const double rise = target.base.z - rules.floor_z_m - rules.gun.pivot_height_m - tip;
  const double reach2 = speed2 * (speed2 - 2.0 * g * rise);  // (g x farthest range)^2
  if (reach2 < 0.0) return 0.0;
  return std::sqrt(reach2) / g + tip + 0.5 * std::hypot(target.size.x, target.size.y);
}

}  // namespace outrider
