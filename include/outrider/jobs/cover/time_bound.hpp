// Between which times a track is driven, proven from its lengths and turns.
//
// What the robot is trusted with: it drives each piece from rest to rest in a trapezoidal profile whose top
// speed lies between its slowest and its full speed; it turns likewise; it stands for the pause where it
// turns in place; it strays from the track by at most `tracking_error_m`. Then a piece of length l has driven
// length l - 2 tracking error to l + 2 tracking error, its headings are off by at most e = asin(2 tracking
// error / l) (any angle when the piece is shorter than that), and a turn t between two pieces becomes t - e -
// e' to t + e + e', at most pi. The time of a profile grows with the distance and falls with the speed, so
// that
//     least = sum of profiles of the shortest lengths and turns at full speed + pauses
//     most  = error_factor (the same of the longest at the slowest speed) + pauses
// `error_factor` >= 1 stands for what is not modelled: a carpet that slows the robot down by it at most.
#pragma once

#include "outrider/jobs/cover/track.hpp"

namespace outrider {

struct TimeBound {
  double least_s = 0.0;
  double most_s = 0.0;
};

/// O(pieces). `tracking_error_m` >= 0.
TimeBound time_bound(const CoverTrack& track, const Pace& pace, double tracking_error_m, double error_factor);

/// Length, m, of `squares` squares one in the other, the first with that edge and each 2 stride smaller than
/// the one around it: 4 edge + 4 (edge - 2 stride) + ... = 4 squares (edge - (squares - 1) stride).
double squares_length_m(double edge_m, double stride_m, int squares);

}  // namespace outrider
