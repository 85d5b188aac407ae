// Track: what is driven to cover an area, and the pace at which it is driven.
//
// The robot turns in place, stands for a pause, drives a leg or an arc from rest to rest, and so on. A turn
// of less than `no_turn_rad` is none: pieces that meet smoothly are joined without a pause.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/profile.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

inline constexpr double no_turn_rad = 1e-6;

/// Speeds are known as spans: the robot goes at least as fast as the slow one and at most as the other.
struct Pace {
  double speed_mps = 0.15;
  double slowest_speed_mps = 0.09;
  double acceleration_mps2 = 0.5;
  double turn_rate_radps = 2.449;
  double slowest_turn_rate_radps = 0.7347;
  double turn_acceleration_radps2 = 10.0;
  double pause_s = 1.0;  ///< the robot stands so long where it turns in place

  [[nodiscard]] Limits straight() const { return {speed_mps, acceleration_mps2}; }
  [[nodiscard]] Limits turning() const { return {turn_rate_radps, turn_acceleration_radps2}; }
  /// The same robot at its slowest.
  [[nodiscard]] Pace slow() const;
};
std::vector<Option> describe(Pace& pace);
/// Refuses a slowest speed or turn rate above the fastest.
Status check(const Pace& pace);

struct CoverTrack {
  Pose2 start;
  std::vector<PathPiece> pieces;  ///< each begins where the one before ends
};

/// Headings in which a piece begins and ends, rad.
double heading_in(const PathPiece& piece);
double heading_out(const PathPiece& piece);

/// The piece driven the other way.
PathPiece reversed(const PathPiece& piece);

struct TrackSums {
  double length_m = 0.0;
  double turned_rad = 0.0;  ///< in place and along arcs
  std::size_t stops = 0;    ///< places where the robot turns in place
  double time_s = 0.0;      ///< at the full speeds of the pace
};

/// Of the pieces, begun in that heading.
TrackSums sums_of(double heading_rad, const std::vector<PathPiece>& pieces, const Pace& pace);

/// Of a drive along the piece: on an arc no faster than the body can turn.
Limits limits_on(const PathPiece& piece, const Pace& pace);

/// Points along the pieces: the ends, and on arcs points that turn by at most `step_rad`.
std::vector<Vec2> points_along(const CoverTrack& track, double step_rad);

}  // namespace outrider
