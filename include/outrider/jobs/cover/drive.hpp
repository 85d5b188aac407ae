// A track driven by an ideal differential robot that goes at its own pace and strays a little.
//
// The robot aims at points beside the ends of the pieces, each drawn from a disk of the stray, and is on
// every piece beside the track by the offsets of its ends, blended. Where that would touch an edge the
// offset is halved until it does not: walls stop the robot. Each turn and each piece has the trapezoidal
// profile of a speed drawn between the slowest and the full. So the drive keeps all that time_bound() and
// the guarantee of a plan ask of a robot, and nothing more. Same seed, same drive.
#pragma once

#include <cstdint>

#include "outrider/jobs/cover/plan.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

struct CoverDrive {
  std::vector<Vec2> way;        ///< driven, with points on arcs every 2 degrees
  std::vector<double> times_s;  ///< at which each of these points is reached
  std::vector<double> ends_s;   ///< of the pieces of the track; its turn and its pause belong to a piece

  /// The poses, without a gun: exact at the points of the way and wherever the acceleration changes. Linear
  /// interpolation is exact at steady speed, and off by at most 3 mm and 4 mrad while it changes.
  std::vector<TrackSample> track;

  double time_s = 0.0;
  double length_m = 0.0;
  double turned_rad = 0.0;  ///< in place and along arcs
  double strayed_m = 0.0;   ///< largest offset
};

/// O(pieces x edges near them).
CoverDrive drive_track(const CoverTrack& track, const PolygonGround& ground, const Pace& pace, double stray_m,
                       std::uint64_t seed);

}  // namespace outrider
