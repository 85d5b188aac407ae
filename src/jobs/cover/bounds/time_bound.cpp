#include "outrider/jobs/cover/bounds/time_bound.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// Largest angle between a piece and what is driven in its place.
double heading_error_rad(double length_m, double tracking_error_m) {
  return 2.0 * tracking_error_m < length_m ? std::asin(2.0 * tracking_error_m / length_m) : pi;
}

}  // namespace

TimeBound time_bound(const CoverTrack& track, const Pace& pace, double tracking_error_m,
                     double error_factor) {
  const Pace slow = pace.slow();
  TimeBound bound;
  double pauses_s = 0.0;
  double heading = track.start.heading_rad, error_before = 0.0;
  for (const PathPiece& piece : track.pieces) {
    const double length = length_of(piece);
    const double error = tracking_error_m > 0.0 ? heading_error_rad(length, tracking_error_m) : 0.0;
    const double turn = std::abs(wrap_angle(heading_in(piece) - heading));
    const double off = error + error_before;
    bound.least_s += duration(std::max(0.0, turn - off), pace.turning());
    bound.most_s += duration(std::min(pi, turn + off), slow.turning());
    if (turn > no_turn_rad) pauses_s += pace.pause_s;
    const double shortest = std::max(0.0, length - 2.0 * tracking_error_m),
                 longest = length + 2.0 * tracking_error_m;
    bound.least_s += duration(shortest, limits_on(piece, pace));
    bound.most_s += duration(longest, limits_on(piece, slow));
    heading = heading_out(piece);
    error_before = error;
  }
  return {bound.least_s + pauses_s, error_factor * bound.most_s + pauses_s};
}

double squares_length_m(double edge_m, double stride_m, int squares) {
  return 4.0 * squares * (edge_m - (squares - 1) * stride_m);
}

}  // namespace outrider
