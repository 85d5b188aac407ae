#include "outrider/ballistics/sight.hpp"

#include <algorithm>
#include <cmath>

#include "in_air.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

/// Returns the corners of the target's footprint with its sides moved outwards by `by_m`.
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
  near_ = &near;
  looked_at_ = 0;
  windows_.clear();
  windows_.reserve(near.size());
}

Window* Sight::window(std::size_t index) {
  while (index >= windows_.size()) {
    if (looked_at_ == near_->size()) return nullptr;
    const Blocker* blocker = (*near_)[looked_at_++];
    if (blocker->hull.empty()) {
      windows_.push_back({blocker, {0.0, aim_m_}});
    } else if (const auto hull = cut(blocker->hull, position_, along_, 0.0, aim_m_)) {
      windows_.push_back({blocker, *hull});
    }
  }
  return &windows_[index];
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
  const double fallen = fall(at, s, aim_z_m);
  if (s <= 0.0 || fallen <= 0.0 || fallen < at.least_drop * (s * s)) return std::nullopt;
  Arc arc{&at, rules_.floor_z_m + at.tip.y, fallen / (s * s), aim_m_, 0.0};
  double z = arc.z(entry_m_);
  if (z >= target_.base.z && z <= target_.base.z + target_.size.z) {
    arc.end_m = entry_m_;
  } else {
    z = aim_z_m;
  }
  arc.lowest_m = std::min(arc.height_m, z);
  return arc;
}

std::size_t Sight::passes(const Elevation& at, const std::vector<double>& aim_z_m) const {
  const double s = aim_m_ - at.tip.x;
  if (s <= 0.0) return 0;
  std::size_t count = aim_z_m.size();
  for (; count > 0; --count) {
    const double fallen = fall(at, s, aim_z_m[count - 1]);
    if (fallen > 0.0 && fallen >= at.least_drop * (s * s)) break;
  }
  return count;
}

void Sight::trim(Window& window, const Elevation& at, const std::vector<double>& aim_z_m, std::size_t& first,
                 std::size_t& last) {
  if (!window.looked_inside) look_inside(window);
  const double grow = rules_.gun.ball_radius_m + rules_.margin_m;
  const double reach = aim_m_ - at.tip.x;
  const auto trim_over = [&](Interval over, double low, double high) {
    over.low = std::max(over.low, at.tip.x);
    if (over.low > over.high) return;
    for (const double distance : {over.low, 0.5 * (over.low + over.high), over.high}) {
      if (distance >= touch_m_) return;
      // z = h + s tan p - (s / reach)^2 fall, and the fall is linear in the aim.
      const double s = distance - at.tip.x;
      const double part = (s / reach) * (s / reach);
      const double base = rules_.floor_z_m + at.tip.y + s * at.tangent - part * fall(at, reach, 0.0);
      const auto inside = [&](double aim) { return base + part * aim >= low && base + part * aim <= high; };
      while (first < last && inside(aim_z_m[first])) ++first;
      while (first < last && inside(aim_z_m[last - 1])) --last;
    }
  };
  trim_over(window.side, window.blocker->low_m, window.blocker->high_m);
  if (first < last) trim_over(window.core, window.blocker->low_m - grow, window.blocker->high_m + grow);
}

Shot Sight::shot(const Arc& arc) const {
  return {heading_of(along_), arc.at->pitch_rad, arc.speed_mps(rules_.gravity_mps2)};
}

Window* Sight::stopped_by(const Arc& arc) {
  for (std::size_t i = 0; Window* const next = window(i); ++i) {
    if (stops(*next, arc)) return next;
  }
  return nullptr;
}

bool Sight::stops(Window& window, const Arc& arc) {
  const Blocker& blocker = *window.blocker;
  const double grow = rules_.gun.ball_radius_m + rules_.margin_m;
  if (arc.lowest_m > blocker.high_m + grow) return false;
  const double from = std::max(window.hull.low, arc.start_m());
  const double to = std::min(window.hull.high, arc.end_m);
  if (from > to) return false;
  if (std::min(arc.z(from), arc.z(to)) > blocker.high_m + grow) return false;
  if (arc.highest(from, to) < blocker.low_m - grow) return false;
  if (!window.looked_inside) look_inside(window);
  if (enters(arc, window.side, blocker.low_m, blocker.high_m)) return true;
  if (enters(arc, window.core, blocker.low_m - grow, blocker.high_m + grow)) return true;
  return touches(window, arc, from, to);
}

/// Returns true if the arc comes between two heights within the part of an interval before the target.
bool Sight::enters(const Arc& arc, Interval over, double low_m, double high_m) const {
  over.low = std::max(over.low, arc.start_m());
  over.high = std::min(over.high, touch_m_ - contact_tolerance_m);
  if (over.low > over.high) return false;
  // Its height is continuous and concave, so it takes all values from the lesser of its ends to its highest.
  return std::min(arc.z(over.low), arc.z(over.high)) <= high_m && arc.highest(over.low, over.high) >= low_m;
}

/// Decides along the flight, by exact distances.
bool Sight::touches(const Window& window, const Arc& arc, double from_m, double to_m) const {
  const double ball = rules_.gun.ball_radius_m;
  const double forward = arc.forward_mps(rules_.gravity_mps2);
  const Vec2 tip = position_ + arc.start_m() * along_;
  const Vec2 ahead = forward * along_;
  const Flight flight{
      {tip.x, tip.y, arc.height_m}, {ahead.x, ahead.y, forward * arc.at->tangent}, rules_.gravity_mps2};
  const auto time = [&](double distance_m) { return (distance_m - arc.start_m()) / forward; };
  const Solid& piece = window.blocker->piece;
  const double open_s = time(std::min(to_m, touch_m_));  // before this time the ball cannot touch the target
  if (outrider::touches(flight, ball + rules_.margin_m, piece, time(from_m), open_s)) return true;
  if (to_m <= touch_m_) return false;
  const auto touch =
      contact_time(flight, ball + rules_.margin_m, piece, std::max(time(from_m), open_s), time(to_m));
  return touch && !outrider::touches(flight, ball, box_, open_s, *touch);
}

double Sight::error_ratio(const Arc& arc) const {
  return outrider::error_ratio(rules_, target_, outline(target_, axis_, along_), aim_m_, *arc.at, arc.drop);
}

Outline outline(const Target& target, Vec2 axis, Vec2 sight) {
  const double c = std::abs(dot(sight, axis));
  const double s = std::abs(cross(sight, axis));
  const double length = 0.5 * target.size.x;
  const double width = 0.5 * target.size.y;
  constexpr double tiny = 1e-9;
  return {std::min(length / std::max(c, tiny), width / std::max(s, tiny)), length * s + width * c};
}

double error_ratio(const ShotRules& rules, const Target& target, const Outline& half, double range_m,
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
  if (!rules.air.none()) return longest_range_in_air(rules, target);
  const double speed2 = rules.gun.muzzle_speed_mps * rules.gun.muzzle_speed_mps;
  const double g = rules.gravity_mps2;
  const double tip = std::hypot(rules.gun.tip_forward_m, rules.gun.tip_up_m);
  const double ground = rules.terrain ? rules.terrain->highest_m() : rules.floor_z_m;
  const double rise = target.base.z - ground - rules.gun.pivot_height_m - tip;
  const double reach2 = speed2 * (speed2 - 2.0 * g * rise);  // (g x farthest range)^2
  if (reach2 < 0.0) return 0.0;
  return std::sqrt(reach2) / g + tip + largest_lean_m(rules) + 0.5 * std::hypot(target.size.x, target.size.y);
}

}  // namespace outrider
