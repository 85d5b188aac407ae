#include "outrider/path/pieces.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {
namespace {

constexpr double hull_step_rad = radians(1.0);

double heading_at(const PathPiece& piece, Vec2 p) {
  const double looks = piece.backward ? -1.0 : 1.0;
  if (piece.turn_rad == 0.0) return heading_of(looks * (piece.to - piece.from));
  const Vec2 aside = perpendicular(p - piece.centre);
  return heading_of((piece.turn_rad > 0.0 ? looks : -looks) * aside);
}

}  // namespace

double heading_in(const PathPiece& piece) { return heading_at(piece, piece.from); }
double heading_out(const PathPiece& piece) { return heading_at(piece, piece.to); }

double turn_in_place(double from_rad, double to_rad) {
  const double turn = wrap_angle(to_rad - from_rad);
  return turn < 1e-6 - pi ? turn + 2.0 * pi : turn;
}

PathPiece reversed(const PathPiece& piece) {
  return {piece.to, piece.from, piece.centre, -piece.turn_rad, piece.backward};
}

Vec2 point_on(const PathPiece& piece, double part) {
  if (part <= 0.0) return piece.from;
  if (part >= 1.0) return piece.to;
  if (piece.turn_rad == 0.0) return piece.from + part * (piece.to - piece.from);
  return piece.centre + rotated(part * piece.turn_rad, piece.from - piece.centre);
}

double nearest_part(const PathPiece& piece, Vec2 p) {
  if (piece.turn_rad == 0.0) {
    const Vec2 along = piece.to - piece.from;
    const double length2 = squared_norm(along);
    return length2 > 0.0 ? std::clamp(dot(p - piece.from, along) / length2, 0.0, 1.0) : 1.0;
  }
  const double side = piece.turn_rad > 0.0 ? 1.0 : -1.0;
  const Vec2 from = piece.from - piece.centre, to = p - piece.centre;
  const double ahead_rad = side * std::atan2(cross(from, to), dot(from, to));
  const double angle_rad = ahead_rad < 0.0 ? ahead_rad + 2.0 * pi : ahead_rad;
  if (angle_rad <= std::abs(piece.turn_rad)) return angle_rad / std::abs(piece.turn_rad);
  return distance(p, piece.from) < distance(p, piece.to) ? 0.0 : 1.0;
}

PathPiece section_of(const PathPiece& piece, double from_part, double to_part) {
  return {point_on(piece, from_part), point_on(piece, to_part), piece.centre,
          (to_part - from_part) * piece.turn_rad, piece.backward};
}

Limits limits_on(const PathPiece& piece, const Pace& pace) {
  Limits limits = pace.straight();
  if (piece.turn_rad != 0.0) {
    limits.speed = std::min(limits.speed, pace.turn_rate_radps * distance(piece.centre, piece.from));
  }
  return limits;
}

std::vector<Vec2> points_along(Vec2 start, const std::vector<PathPiece>& pieces, double step_rad) {
  std::vector<Vec2> points{start};
  for (const PathPiece& piece : pieces) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(piece.turn_rad) / step_rad)));
    const Vec2 arm = piece.from - piece.centre;
    for (int i = 1; i < steps; ++i) {
      const double angle = piece.turn_rad * i / steps;
      points.push_back(piece.centre + std::cos(angle) * arm + std::sin(angle) * perpendicular(arm));
    }
    points.push_back(piece.to);
  }
  return points;
}

Box2 bounds_of(const PathPiece& piece) {
  Box2 box;
  box.include(piece.from);
  box.include(piece.to);
  if (piece.turn_rad == 0.0) return box;
  const double begin = heading_of(piece.from - piece.centre), end = begin + piece.turn_rad;
  const auto [low, high] = std::minmax(begin, end);
  for (double quarter = std::ceil(low / (0.5 * pi)); quarter * 0.5 * pi <= high; ++quarter) {
    box.include(piece.centre + distance(piece.centre, piece.from) * direction(quarter * 0.5 * pi));
  }
  return box;
}

PathPiece carried(const PathPiece& piece, double heading_rad, Vec2 at) {
  PathPiece other = piece;
  other.from = piece.from + rotated(heading_rad, at);
  other.to = piece.to + rotated(heading_rad + piece.turn_rad, at);
  return other;
}

PathPiece seen_from(const PathPiece& piece, double heading_rad, Vec2 place) {
  const Pose2 begin{piece.from, heading_rad}, end{piece.to, heading_rad + piece.turn_rad};
  return {begin.to_local(place), end.to_local(place), begin.to_local(piece.centre), -piece.turn_rad};
}

std::vector<std::vector<Vec2>> swept_hulls(const Plan& plan, const std::vector<Vec2>& outline) {
  std::vector<std::vector<Vec2>> hulls;
  const auto add = [&](const Pose2& a, const Pose2& b) {
    std::vector<Vec2> points{a.position, b.position};
    for (const Vec2 corner : outline) {
      points.push_back(a * corner);
      points.push_back(b * corner);
    }
    hulls.push_back(convex_hull(std::move(points)));
  };
  if (!plan.steering || plan.pieces.empty()) {
    for (std::size_t i = 0; i < plan.waypoints.size(); ++i)
      add({plan.waypoints[i == 0 ? 0 : i - 1], 0.0}, {plan.waypoints[i], 0.0});
    return hulls;
  }
  for (const PathPiece& piece : plan.pieces) {
    const double begin_rad = heading_in(piece);
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(piece.turn_rad) / hull_step_rad)));
    const auto pose = [&](int step) {
      const double part = static_cast<double>(step) / steps;
      return Pose2{point_on(piece, part), begin_rad + part * piece.turn_rad};
    };
    for (int i = 0; i < steps; ++i) add(pose(i), pose(i + 1));
  }
  return hulls;
}

double hulls_error_m(const Plan& plan, const std::vector<Vec2>& outline) {
  if (!plan.steering) return 0.0;
  double radius_m = 0.0, outer_m = 0.0;
  for (const PathPiece& piece : plan.pieces) {
    if (piece.turn_rad != 0.0) radius_m = std::max(radius_m, distance(piece.centre, piece.from));
  }
  for (const Vec2 corner : outline) outer_m = std::max(outer_m, norm(corner));
  return (radius_m + outer_m) * (1.0 - std::cos(0.5 * hull_step_rad));
}

}  // namespace outrider
