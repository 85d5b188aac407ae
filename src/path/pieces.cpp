#include "outrider/path/pieces.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

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

}  // namespace outrider
