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

Elevation elevation(const ShotRules& rules, double pitch_rad) {
  const double cosine = std::cos(pitch_rad);
  const double forward = rules.gun.muzzle_speed_mps * cosine;
  return {pitch_rad, std::tan(pitch_rad), cosine, muzzle(rules.gun, pitch_rad),
          rules.gravity_mps2 / (2.0 * forward * forward)};
}

Sight::Sight(const ShotRules& rules, const Target& target)
    : rules_(rules),
      target_(target),
      box_(solid_of(target)),
      axis_(direction(target.yaw_rad)),
      footprint_(ground_box(target, 0.0)),
      reach_(ground_box(target, rules.gun.ball_radius_m + contact_tolerance_m)) {}

void Sight::look(Vec2 position, Vec2 aim, const std::vector<const Blocker*>& near) {
  const Vec2 line = aim - position;
  position_ = position;
  aim_m_ = norm(line);
  along_ = 1.0 / aim_m_ * line;
  const auto inside = cut(footprint_, position, along_, 0.0, aim_m_);
  const auto near_it = cut(reach_, position, along_, 0.0, aim_m_);
  entry_m_ = inside ? inside->low : aim_m_;
  touch_m_ = near_it ? near_it->low : entry_m_;
  windows_.clear();
  for (const Blocker* blocker : near) {
    if (blocker->hull.empty()) {
      windows_.push_back({blocker, {0.0, aim_m_}});
    } else if (const auto hull = cut(blocker->hull, position, along_, 0.0, aim_m_)) {
      windows_.push_back({blocker, *hull});
    }
  }
}

void Sight::look_inside(Window& window) const {
  window.looked_inside = true;
  const Blocker& blocker = *window.blocker;
  if (blocker.side.empty()) return;
  const auto side = cut(blocker.side, position_, along_, window.hull.low, window.hull.high);
  if (!side) return;
  window.side = *side;
  window.core = cut(blocker.core, position_, along_, side->low, side->high).value_or(window.core);
}

std::optional<Arc> Sight::arc(const Elevation& at, double aim_z_m) const {
  const double s = aim_m_ - at.tip.x;
  if (s <= 0.0) return std::nullopt;
  const double height = rules_.floor_z_m + at.tip.y;
  const double fall = height + s * at.tangent - aim_z_m;
  if (fall <= 0.0 || fall < at.least_drop * (s * s)) return std::nullopt;
  return Arc{&at, height, fall / (s * s)};
}

Shot Sight::shot(const Arc& arc) const {
  return {heading_of(along_), arc.at->pitch_rad, arc.speed_mps(rules_.gravity_mps2)};
}

Window* Sight::stopped_by(const Arc& arc) {
  const auto first =
      std::find_if(windows_.begin(), windows_.end(), [&](Window& window) { return stops(window, arc); });
  return first == windows_.end() ? nullptr : &*first;
}

bool Sight::stops(Window& window, const Arc& arc) {
  const Blocker& blocker = *window.blocker;
  const double grow = rules_.gun.ball_radius_m + rules_.margin_m;
  const double z_entry = arc.z(entry_m_);
  const bool by_the_side = z_entry >= target_.base.z && z_entry <= target_.base.z + target_.size.z;
  const double from = std::max(window.hull.low, arc.start_m());
  const double to = std::min(window.hull.high, by_the_side ? entry_m_ : aim_m_);
  if (from > to) return false;
  if (std::min(arc.z(from), arc.z(to)) > blocker.high_m + grow) return false;
  if (arc.highest(from, to) < blocker.low_m - grow) return false;
  if (!window.looked_inside) look_inside(window);
  if (enters(arc, window.side, blocker.low_m, blocker.high_m)) return true;
  if (enters(arc, window.core, blocker.low_m - grow, blocker.high_m + grow)) return true;
  return touches(window, arc, from, to);
}

/// Whether the arc is seen, at one of three places, between two heights over an interval that lies before
/// the target.
bool Sight::enters(const Arc& arc, Interval over, double low_m, double high_m) const {
  over.low = std::max(over.low, arc.start_m());
  if (over.low > over.high) return false;
  for (const double at : {over.low, 0.5 * (over.low + over.high), over.high}) {
    const double z = arc.z(at);
    if (at < touch_m_ && z >= low_m && z <= high_m) return true;
  }
  return false;
}

/// Decided along the flight, by conservative advancement.
bool Sight::touches(const Window& window, const Arc& arc, double from_m, double to_m) const {
  const double ball = rules_.gun.ball_radius_m;
  const double forward = arc.forward_mps(rules_.gravity_mps2);
  const Vec2 tip = position_ + arc.start_m() * along_;
  const Vec2 ahead = forward * along_;
  const Flight flight{
      {tip.x, tip.y, arc.height_m}, {ahead.x, ahead.y, forward * arc.at->tangent}, rules_.gravity_mps2};
  const auto time = [&](double distance_m) { return (distance_m - arc.start_m()) / forward; };
  const auto touch =
      contact_time(flight, ball + rules_.margin_m, window.blocker->piece, time(from_m), time(to_m));
  if (!touch) return false;
  const bool target_first = arc.start_m() + *touch * forward >= touch_m_ &&
                            contact_time(flight, ball, box_, 0.0, *touch).has_value();
  return !target_first;
}

double Sight::spread(const Arc& arc) const {
  return outrider::spread(rules_, target_, outline(target_, axis_, along_), aim_m_, *arc.at, arc.drop);
}

Outline outline(const Target& target, Vec2 axis, Vec2 sight) {
  const double c = std::abs(dot(sight, axis));
  const double s = std::abs(cross(sight, axis));
  const double length = 0.5 * target.size.x;
  const double width = 0.5 * target.size.y;
  constexpr double tiny = 1e-9;
  return {std::min(length / std::max(c, tiny), width / std::max(s, tiny)), length * s + width * c};
}

double spread(const ShotRules& rules, const Target& target, const Outline& half, double range_m,
              const Elevation& at, double drop) {
  const double s = range_m - at.tip.x;
  const double slope = at.tangent - 2.0 * drop * s;
  // z(s) = h + s tan p - k s^2, where dh/dp = tip.x and ds/dp = tip.y - pivot:
  // dz/dp = tip.x + slope ds/dp + s / cos^2 p - 2 k s^2 tan p, dz/dv = 2 k s^2 / v.
  const double by_pitch = std::abs(at.tip.x + slope * (at.tip.y - rules.gun.pivot_height_m) +
                                   s / (at.cosine * at.cosine) - 2.0 * drop * s * s * at.tangent);
  const double vertical = by_pitch * rules.errors.gun_rad + 2.0 * drop * s * s * rules.errors.speed_ratio;
  const double lateral = range_m * rules.errors.gun_rad;
  const double ball = rules.gun.ball_radius_m;
  return std::max(vertical / (0.5 * target.size.z + half.along_m * std::abs(slope) + ball),
                  lateral / (half.across_m + ball));
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
