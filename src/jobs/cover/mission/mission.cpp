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

namespace {

/// Counts how often the robot came nearer to an edge than its radius.
std::size_t contacts_of(const PieceDrive& drive, const PolygonGround& ground) {
  std::size_t contacts = 0;
  bool was_free = true;
  for (const Vec2 place : drive.way) {
    const bool free = ground.point_free(place);
    if (was_free && !free) ++contacts;
    was_free = free;
  }
  return contacts;
}

}  // namespace

FaultyDrive drive_with_faults(const CoverTrack& track, const CoverProblem& problem,
                              const std::shared_ptr<const PolygonGround>& ground, const TrackFaults& faults,
                              std::uint64_t seed, const RunWatch& watch,
                              const std::function<void(const PieceDrive&, const CoverRecovery&)>& look) {
  SimulatedRobot robot(
      PieceBody(track.start, problem.pace, problem.tracking_error_m, *ground, Rng(seed), faults));
  const auto& body = robot.body<PieceBody>();
  Budget budget;
  budget.stop = watch.stop;
  FaultyDrive done{{}, CoverRecovery(track, problem, ground, budget)};
  done.finished = run_mission(done.mission, robot, watch.stop, [&](const Observation&, const Command*) {
    watch.part(done.mission.driven_part());
    if (look) look(body.drive(), done.mission);
  });
  done.drive = body.drive();
  done.contacts = body.hindrance().contacts() + contacts_of(done.drive, *ground);
  done.post_contacts = body.hindrance().post_contacts();
  return done;
}

}  // namespace outrider
