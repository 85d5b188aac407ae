#include "outrider/path/pieces.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double way_step_rad = radians(1.0);

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

std::vector<PathPiece> carried(const std::vector<PathPiece>& pieces, double ahead_m) {
  std::vector<PathPiece> other = pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    other[i].from = pieces[i].from + ahead_m * direction(heading_in(pieces[i]));
    other[i].to = pieces[i].to + ahead_m * direction(heading_out(pieces[i]));
  }
  return other;
}

std::vector<std::vector<Vec2>> disk_ways(const Plan& plan) {
  if (!plan.steering || plan.pieces.empty()) return {plan.waypoints};
  std::vector<std::vector<Vec2>> ways;
  for (const double ahead_m : plan.steering->disks_m) {
    const std::vector<PathPiece> pieces = carried(plan.pieces, ahead_m);
    ways.push_back(points_along(pieces.front().from, pieces, way_step_rad));
  }
  return ways;
}

double disk_way_error_m(const Plan& plan) {
  if (!plan.steering) return 0.0;
  double radius_m = 0.0;
  for (const PathPiece& piece : plan.pieces) {
    if (piece.turn_rad != 0.0) radius_m = std::max(radius_m, distance(piece.centre, piece.from));
  }
  double ahead_m = 0.0;
  for (const double disk_m : plan.steering->disks_m) ahead_m = std::max(ahead_m, std::abs(disk_m));
  return std::hypot(radius_m, ahead_m) * (1.0 - std::cos(0.5 * way_step_rad));
}

}  // namespace outrider
