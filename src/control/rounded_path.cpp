#include "outrider/control/rounded_path.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr int steps = 64;       ///< of a corner
constexpr int least_parts = 8;  ///< of a straight part

/// The curve of a corner.
struct Corner {
  Vec2 at, in, out;      // the corner, and the directions before and behind it
  double reach_m = 0.0;  // a
  double turn_rad = 0.0;

  [[nodiscard]] Vec2 point(double t) const {
    const double u = 1.0 - t;
    return at + reach_m * (t * t * t * out - u * u * u * in);
  }
  [[nodiscard]] Vec2 by_t(double t) const {
    const double u = 1.0 - t;
    return 3.0 * reach_m * (u * u * in + t * t * out);
  }
  [[nodiscard]] double curvature(double t) const {
    const double speed = norm(by_t(t));
    const double bend = 18.0 * reach_m * reach_m * t * (1.0 - t) * cross(in, out);
    return bend == 0.0 ? 0.0 : bend / (speed * speed * speed);
  }
  /// The length between two parameters, by Gauss's rule of two points.
  [[nodiscard]] double length(double from, double to) const {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from), off = half / std::sqrt(3.0);
    return half * (norm(by_t(middle - off)) + norm(by_t(middle + off)));
  }
};

Corner corner_of(Vec2 before, Vec2 at, Vec2 after, double room_m, double share_before, double share_after) {
  const double before_m = distance(before, at), after_m = distance(at, after);
  Corner corner{at, (1.0 / before_m) * (at - before), (1.0 / after_m) * (after - at), 0.0, 0.0};
  corner.turn_rad = std::atan2(cross(corner.in, corner.out), dot(corner.in, corner.out));
  const double sine = std::abs(std::sin(0.5 * corner.turn_rad));
  const double most_m = std::min(share_before * before_m, share_after * after_m);
  corner.reach_m = 4.0 * room_m < most_m * sine ? 4.0 * room_m / sine : most_m;
  return corner;
}

/// Appends a straight part.
void add_straight(std::vector<PathPoint>& points, Vec2 to, double spacing_m) {
  const PathPoint from = points.back();
  const double length_m = distance(from.position, to);
  if (length_m < 1e-9) return;
  const int parts = std::max(least_parts, static_cast<int>(std::ceil(length_m / spacing_m)));
  for (int i = 1; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    points.push_back({from.position + share * (to - from.position), from.along_m + share * length_m,
                      from.tangent_rad, 0.0});
  }
}

void add_corner(std::vector<PathPoint>& points, const Corner& corner) {
  if (corner.reach_m == 0.0) {  // sharp: two points at one place
    PathPoint turned = points.back();
    turned.tangent_rad += corner.turn_rad;
    points.push_back(turned);
    return;
  }
  for (int i = 1; i <= steps; ++i) {
    const double before = static_cast<double>(i - 1) / steps, t = static_cast<double>(i) / steps;
    const PathPoint& last = points.back();
    const double turn = wrap_angle(heading_of(corner.by_t(t)) - last.tangent_rad);
    points.push_back({corner.point(t), last.along_m + corner.length(before, t), last.tangent_rad + turn,
                      corner.curvature(t)});
  }
}

}  // namespace

std::vector<PathPoint> rounded_path(const std::vector<Vec2>& corners, const std::vector<double>& rooms,
                                    double spacing_m) {
  std::vector<PathPoint> points = {{corners[0], 0.0, heading_of(corners[1] - corners[0]), 0.0}};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const double share_before = i == 1 ? 1.0 : 0.5, share_after = i + 2 == corners.size() ? 1.0 : 0.5;
    const Corner corner =
        corner_of(corners[i - 1], corners[i], corners[i + 1], rooms[i - 1], share_before, share_after);
    add_straight(points, corner.point(0.0), spacing_m);
    add_corner(points, corner);
  }
  add_straight(points, corners.back(), spacing_m);
  return points;
}

std::vector<Vec2> rounded_corner(Vec2 before, Vec2 corner, Vec2 after, double room_m, double share_before,
                                 double share_after) {
  const Corner curve = corner_of(before, corner, after, room_m, share_before, share_after);
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) points.push_back(curve.point(static_cast<double>(i) / steps));
  return points;
}

}  // namespace outrider
