// TimeBound: a lower and an upper bound of the driving time of a track, proven from its lengths and turns.
//
// Model of the robot: it drives each piece from rest to rest in a trapezoidal profile whose top speed lies
// between its slowest and its full speed; it turns likewise; it stands for the pause where it turns in place;
// its tracking error is at most d = `tracking_error_m`. Then it drives l - 2 d to l + 2 d on a piece of
// length l, with a heading error of at most e = asin(2 d / l) (any angle if the piece is shorter than 2 d),
// and a turn t between two pieces becomes t - e - e' to t + e + e', at most pi. The time of a profile grows
// with the distance and falls with the speed, so
//     least = sum of profiles of the shortest lengths and turns at full speed + pauses
//     most  = error_factor (the same of the longest at the slowest speed) + pauses
// `error_factor` >= 1 stands for effects that are not modelled, such as a carpet that slows the robot down.
#pragma once

#include "outrider/jobs/cover/strokes/track.hpp"

namespace outrider {

/// Bounds of a driving time.
struct TimeBound {
  double least_s = 0.0;  ///< no drive is faster
  double most_s = 0.0;   ///< no drive is slower
};

/// Returns the bounds. `tracking_error_m` must not be negative. O(pieces).
TimeBound time_bound(const CoverTrack& track, const Pace& pace, double tracking_error_m, double error_factor);

/// Returns the length of `squares` nested squares, m. The outer one has the edge `edge_m`, and each edge is 2
/// stride shorter than the one around it: 4 edge + 4 (edge - 2 stride) + ... = 4 squares (edge - (squares -
/// 1) stride).
double squares_length_m(double edge_m, double stride_m, int squares);

}  // namespace outrider
