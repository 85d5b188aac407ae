#include "outrider/jobs/cover/mission/mission.hpp"

#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

CoverMission::CoverMission(CoverTrack driven, double pause)
    : track(std::move(driven)), pause_s(pause), heading_rad(track.start.heading_rad) {}

std::optional<Command> CoverMission::step(const Observation&) {
  if (next == track.pieces.size()) return std::nullopt;
  FollowPiece command{track.pieces[next++]};
  if (next < track.pieces.size()) command.next = track.pieces[next];
  const bool turns = std::abs(wrap_angle(heading_in(command.piece) - heading_rad)) > no_turn_rad;
  if (turns) command.pause_s = pause_s;
  heading_rad = heading_out(command.piece);
  return command;
}

PieceDrive drive_track(const CoverTrack& track, const PolygonGround& ground, const Pace& pace,
                       double tracking_error_m, std::uint64_t seed, const RunWatch& watch,
                       const std::function<void(const PieceDrive&)>& look) {
  SimulatedRobot robot(PieceBody(track.start, pace, tracking_error_m, ground, Rng(seed)));
  CoverMission mission(track, pace.pause_s);
  const PieceDrive& drive = robot.body<PieceBody>().drive();
  run_mission(mission, robot, watch.stop, [&](const Observation&, const Command*) {
    watch.part(static_cast<double>(drive.ends_s.size()) / static_cast<double>(track.pieces.size()));
    if (look) look(drive);
  });
  return drive;
}

}  // namespace outrider
