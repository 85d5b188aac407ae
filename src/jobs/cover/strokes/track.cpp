#include "outrider/jobs/cover/strokes/track.hpp"

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {

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

}  // namespace outrider
