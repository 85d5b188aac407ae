// CoverMission executes a track piece by piece. drive_track() simulates it, and drive_with_faults() simulates
// CoverRecovery with a robot that is held up.
#pragma once

#include <cstdint>
#include <functional>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/cover/mission/recovery.hpp"
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

/// A drive with faults that the robot was not told.
struct FaultyDrive {
  PieceDrive drive;
  CoverRecovery mission;          ///< in its last state
  std::size_t contacts = 0;       ///< with the edge of the area
  std::size_t post_contacts = 0;  ///< with the post that was put on its way
  bool finished = false;          ///< nobody stopped it
};

/// Drives the track of the problem on that ground with a robot that suffers the faults. `look` receives the
/// drive and the mission so far.
FaultyDrive drive_with_faults(const CoverTrack& track, const CoverProblem& problem,
                              const std::shared_ptr<const PolygonGround>& ground, const TrackFaults& faults,
                              std::uint64_t seed, const RunWatch& watch = {},
                              const std::function<void(const PieceDrive&, const CoverRecovery&)>& look = {});

}  // namespace outrider
