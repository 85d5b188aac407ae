// Track: what is driven to cover an area.
//
// The robot turns in place, stands for a pause, drives a leg or an arc from rest to rest, and so on. A turn
// of less than `no_turn_rad` is none: pieces that meet smoothly are joined without a pause.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {

inline constexpr double no_turn_rad = 1e-6;

struct CoverTrack {
  Pose2 start;
  std::vector<PathPiece> pieces;  ///< each begins where the one before ends
};

struct TrackSums {
  double length_m = 0.0;
  double turned_rad = 0.0;  ///< in place and along arcs
  std::size_t stops = 0;    ///< places where the robot turns in place
  double time_s = 0.0;      ///< at the full speeds of the pace
};

/// Of the pieces, begun in that heading.
TrackSums sums_of(double heading_rad, const std::vector<PathPiece>& pieces, const Pace& pace);

}  // namespace outrider
