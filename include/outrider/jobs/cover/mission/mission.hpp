// CoverMission executes a track piece by piece. drive_track() simulates it.
#pragma once

#include <cstdint>
#include <functional>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/cover/strokes/track.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/bodies/piece_body.hpp"

namespace outrider {

/// The state of the execution.
struct CoverMission {
  CoverMission(CoverTrack driven, double pause);

  /// Returns the next FollowPiece, or nothing after the last piece. The robot pauses where the track turns in
  /// place.
  std::optional<Command> step(const Observation& seen);

  CoverTrack track;
  double pause_s;        ///< pause at each turn in place
  double heading_rad;    ///< heading of the track at the start of the next piece
  std::size_t next = 0;  ///< index of the next piece
};

/// Drives the track with a simulated robot whose tracking error is at most `tracking_error_m`. A drive that
/// is stopped has the pieces driven until then. `watch` receives the fraction of the pieces that are driven,
/// and `look` the drive so far after each piece.
PieceDrive drive_track(const CoverTrack& track, const PolygonGround& ground, const Pace& pace,
                       double tracking_error_m, std::uint64_t seed, const RunWatch& watch = {},
                       const std::function<void(const PieceDrive&)>& look = {});

}  // namespace outrider
