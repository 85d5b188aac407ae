// CoverMission: the execution of a track, piece by piece; and a simulated drive of it.
#pragma once

#include <cstdint>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/cover/track.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/piece_body.hpp"

namespace outrider {

struct CoverMission {
  CoverMission(CoverTrack driven, double pause);

  /// The next FollowPiece, or nothing after the last. The robot pauses where the track turns in place.
  std::optional<Command> step(const Observation& seen);

  CoverTrack track;
  double pause_s;
  double heading_rad;    ///< of the track where the next piece begins
  std::size_t next = 0;  ///< of the pieces
};

/// Drives the track on a simulated robot. Of a drive that was stopped it has the pieces driven until then.
/// `watch` is told the part of the pieces that are driven.
PieceDrive drive_track(const CoverTrack& track, const PolygonGround& ground, const Pace& pace,
                       double tracking_error_m, std::uint64_t seed, const RunWatch& watch = {});

}  // namespace outrider
