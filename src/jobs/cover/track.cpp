#include "outrider/jobs/cover/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

double heading_at(const PathPiece& piece, Vec2 p) {
  if (piece.turn_rad == 0.0) return heading_of(piece.to - piece.from);
  const Vec2 aside = perpendicular(p - piece.centre);
  return heading_of(piece.turn_rad > 0.0 ? aside : -aside);
}

}  // namespace

Pace Pace::slow() const {
  Pace slow = *this;
  slow.speed_mps = slowest_speed_mps;
  slow.turn_rate_radps = slowest_turn_rate_radps;
  return slow;
}

std::vector<Option> describe(Pace& pace) {
  return {
      {"speed", "m/s", 1e-3, 100.0, "driving speed", &pace.speed_mps},
      {"slowest_speed", "m/s", 1e-3, 100.0, "driving speed that the robot never falls below on the way",
       &pace.slowest_speed_mps},
      {"acceleration", "m/s2", 1e-3, 1e3, "driving acceleration", &pace.acceleration_mps2},
      {"turn_rate", "rad/s", 1e-3, 100.0, "turning speed", &pace.turn_rate_radps},
      {"slowest_turn_rate", "rad/s", 1e-3, 100.0, "turning speed that the robot never falls below",
       &pace.slowest_turn_rate_radps},
      {"turn_acceleration", "rad/s2", 1e-3, 1e4, "turning acceleration", &pace.turn_acceleration_radps2},
      {"pause", "s", 0.0, 1e3, "how long the robot stands where it turns in place", &pace.pause_s},
  };
}

Status check(const Pace& pace) {
  if (pace.slowest_speed_mps > pace.speed_mps) {
    return bad_input(fmt::format("{:g} m/s is above the speed of {:g} m/s; give at most that",
                                 pace.slowest_speed_mps, pace.speed_mps),
                     "pace.slowest_speed");
  }
  if (pace.slowest_turn_rate_radps > pace.turn_rate_radps) {
    return bad_input(fmt::format("{:g} rad/s is above the turn rate of {:g} rad/s; give at most that",
                                 pace.slowest_turn_rate_radps, pace.turn_rate_radps),
                     "pace.slowest_turn_rate");
  }
  return {};
}

double heading_in(const PathPiece& piece) { return heading_at(piece, piece.from); }
double heading_out(const PathPiece& piece) { return heading_at(piece, piece.to); }

PathPiece reversed(const PathPiece& piece) { return {piece.to, piece.from, piece.centre, -piece.turn_rad}; }

Limits limits_on(const PathPiece& piece, const Pace& pace) {
  Limits limits = pace.straight();
  if (piece.turn_rad != 0.0) {
    limits.speed = std::min(limits.speed, pace.turn_rate_radps * distance(piece.centre, piece.from));
  }
  return limits;
}

TrackSums sums_of(double heading_rad, const std::vector<PathPiece>& pieces, const Pace& pace) {
  TrackSums sums;
  for (const PathPiece& piece : pieces) {
    const double turn = std::abs(wrap_angle(heading_in(piece) - heading_rad));
    if (turn > no_turn_rad) {
      ++sums.stops;
      sums.turned_rad += turn;
      sums.time_s += duration(turn, pace.turning()) + pace.pause_s;
    }
    const double length = length_of(piece);
    sums.length_m += length;
    sums.turned_rad += std::abs(piece.turn_rad);
    sums.time_s += duration(length, limits_on(piece, pace));
    heading_rad = heading_out(piece);
  }
  return sums;
}

std::vector<Vec2> points_along(const CoverTrack& track, double step_rad) {
  std::vector<Vec2> points{track.start.position};
  for (const PathPiece& piece : track.pieces) {
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
