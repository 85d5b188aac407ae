#include "outrider/ballistics/sight.hpp"

#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

bool is_upright_prism(const Solid& solid) {
  const bool upright = std::abs(solid.world_T_solid.rotation.axes[2].z) >= 1.0 - 1e-12;
  return upright && (std::holds_alternative<BoxShape>(solid.shape) ||
                     std::holds_alternative<CylinderShape>(solid.shape));
}

/// Convex pieces with distances of their own: a mesh falls into its triangles.
std::vector<Solid> convex_pieces(const Solid& solid) {
  const auto* mesh = std::get_if<MeshShape>(&solid.shape);
  if (mesh == nullptr) return {solid};
  std::vector<Solid> pieces;
  for (const auto& triangle : mesh->triangles) {
    pieces.push_back({solid.name, solid.world_T_solid, MeshShape{{triangle}}});
  }
  return pieces;
}

Blocker blocker_of(const Solid& piece, std::size_t index, double grow_m) {
  Blocker blocker{piece, index, {}, {}, 0.0, 0.0};
  const Box3 box = bounds(piece);
  blocker.low_m = box.low.z;
  blocker.high_m = box.high.z;
  const auto shapes = footprint(piece, -inf, inf);
  if (shapes.empty()) return blocker;  // a half-space: met everywhere
  RoundedPolygon grown = shapes.front();
  if (is_upright_prism(piece)) {
    // Inside a cylinder's footprint the inscribed square is enough to see most hits at once.
    blocker.core = grown.core;
    if (grown.core.size() == 1) {
      const double half = grown.radius_m * std::sqrt(0.5);
      const Vec2 c = grown.core.front();
      blocker.core = {{c.x - half, c.y - half},
                      {c.x + half, c.y - half},
                      {c.x + half, c.y + half},
                      {c.x - half, c.y + half}};
    }
  }
  grown.radius_m += grow_m;
  blocker.hull = circumscribed(grown, radians(46.0));
  return blocker;
}

/// Half-planes a x + b y >= c that bound the cone of places behind a hull, seen from the target.
struct Cone {
  bool everywhere = false;
  std::array<std::array<double, 3>, 3> sides{};

  /// The x at which a row of height y enters and leaves the cone.
  [[nodiscard]] Interval row(double y) const {
    Interval x{-inf, inf};
    if (everywhere) return x;
    for (const auto& [a, b, c] : sides) {
      const double rest = c - b * y;
      if (a > 0.0) {
        x.low = std::max(x.low, rest / a);
      } else if (a < 0.0) {
        x.high = std::min(x.high, rest / a);
      } else if (rest > 0.0) {
        return {inf, -inf};
      }
    }
    return x;
  }
};

Cone cone_behind(const std::vector<Vec2>& hull, Vec2 eye) {
  Cone cone;
  bool inside = true;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 a = hull[i];
    inside = inside && cross(hull[(i + 1) % hull.size()] - a, eye - a) >= -1e-9;
  }
  if (inside) {
    cone.everywhere = true;
    return cone;
  }
  Vec2 right = hull.front() - eye;
  Vec2 left = right;
  for (const Vec2 corner : hull) {
    const Vec2 ray = corner - eye;
    if (cross(right, ray) < 0.0) right = ray;
    if (cross(left, ray) > 0.0) left = ray;
  }
  const Vec2 axis = 1.0 / norm(right) * right + 1.0 / norm(left) * left;
  double nearest = inf;
  for (const Vec2 corner : hull) nearest = std::min(nearest, dot(axis, corner - eye));
  // cross(right, p - eye) >= 0, cross(p - eye, left) >= 0, dot(axis, p - eye) >= nearest
  cone.sides = {{{-right.y, right.x, cross(right, eye)},
                 {left.y, -left.x, cross(eye, left)},
                 {axis.x, axis.y, nearest + dot(axis, eye)}}};
  return cone;
}

/// Corners of the target's footprint with its sides moved out by `by_m`.
std::vector<Vec2> ground_box(const Target& target, double by_m) {
  const Vec2 x = (0.5 * target.size.x + by_m) * direction(target.yaw_rad);
  const Vec2 y = (0.5 * target.size.y + by_m) * perpendicular(direction(target.yaw_rad));
  const Vec2 c = xy(target.base);
  return {c - x - y, c + x - y, c + x + y, c - x + y};
}

struct Span {
  int first;
  int last;
  const Blocker* blocker;
};

}  // namespace

std::vector<Blocker> blockers(const FlightSpace& space, double grow_m) {
  std::vector<Blocker> all;
  for (std::size_t i = 0; i < space.solids().size(); ++i) {
    for (const Solid& piece : convex_pieces(space.solids()[i])) {
      all.push_back(blocker_of(piece, i, grow_m));
    }
  }
  return all;
}

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

void sweep(const std::vector<Blocker>& all, Vec2 centre, double reach_m, double spare_m,
           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
           const std::function<bool(std::size_t, const std::vector<const Blocker*>&)>& visit) {
  std::vector<Cone> cones;
  for (const Blocker& blocker : all) {
    const auto& hull = blocker.hull;
    cones.push_back(hull.empty()     ? Cone{true, {}}
                    : spare_m == 0.0 ? cone_behind(hull, centre)
                                     : cone_behind(circumscribed({hull, spare_m}, radians(91.0)), centre));
  }
  const double step = frame.resolution_m;
  const auto column = [&](double x) {
    return std::clamp((x - frame.origin.x) / step - 0.5, -1.0, static_cast<double>(frame.width));
  };
  std::vector<Span> spans;
  std::vector<Span> active;
  std::vector<const Blocker*> near;
  for (int row = 0; row < frame.height; ++row) {
    const double y = frame.centre({0, row}).y;
    const double chord2 = reach_m * reach_m - (y - centre.y) * (y - centre.y);
    if (chord2 < 0.0) continue;
    const double chord = std::sqrt(chord2);
    const int first = std::max(0, static_cast<int>(std::ceil(column(centre.x - chord))));
    const int last = std::min(frame.width - 1, static_cast<int>(std::floor(column(centre.x + chord))));
    spans.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Interval x = cones[i].row(y);
      if (x.low > x.high) continue;
      // One cell more on each side, so that rounding never hides a blocker.
      const Span span{static_cast<int>(std::floor(column(x.low))) - 1,
                      static_cast<int>(std::ceil(column(x.high))) + 1, &all[i]};
      if (span.last >= first && span.first <= last) spans.push_back(span);
    }
    std::stable_sort(spans.begin(), spans.end(),
                     [](const Span& a, const Span& b) { return a.first < b.first; });
    active.clear();
    std::size_t next = 0;
    for (int x = first; x <= last; ++x) {
      const auto ended =
          std::remove_if(active.begin(), active.end(), [x](const Span& s) { return s.last < x; });
      bool changed = ended != active.end() || x == first;
      active.erase(ended, active.end());
      for (; next < spans.size() && spans[next].first <= x; ++next) {
        if (spans[next].last < x) continue;
        active.push_back(spans[next]);
        changed = true;
      }
      if (changed) {
        near.clear();
        for (const Span& span : active) near.push_back(span.blocker);
      }
      const std::size_t cell = frame.index({x, row});
      if (standable[cell] != 0 && !visit(cell, near)) return;
    }
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
