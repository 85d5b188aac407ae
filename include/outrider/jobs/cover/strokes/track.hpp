// CoverTrack: the sequence of legs and arcs that covers an area.
//
// The robot turns in place, stands for a pause, drives a leg or an arc from rest to rest, and so on. A turn
// of less than `no_turn_rad` does not count: pieces that meet smoothly are joined without a pause.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {

/// Smaller turns do not count.
inline constexpr double no_turn_rad = 1e-6;

/// A track.
struct CoverTrack {
  Pose2 start;
  std::vector<PathPiece> pieces;  ///< each begins where the one before ends
};

/// Totals of a track.
struct TrackSums {
  double length_m = 0.0;    ///< of all pieces
  double turned_rad = 0.0;  ///< turned in place and along arcs
  std::size_t stops = 0;    ///< number of turns in place
  double time_s = 0.0;      ///< driving time at full speed
};

/// Returns the totals of the pieces for a robot that starts with this heading.
TrackSums sums_of(double heading_rad, const std::vector<PathPiece>& pieces, const Pace& pace);

}  // namespace outrider
