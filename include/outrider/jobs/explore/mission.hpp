// The execution of exploring: a pure step from what a robot with a range finder senses to the twist it
// commands.
//
// perceive() takes in an observation: each scan goes through SLAM, and between scans the wheels carry the
// pose on. respond() brings the frontiers up to date, decides where to go (explore/decide.hpp) and drives
// there (control/steer.hpp). It decides anew when the frontier it goes for has dissolved, when the way there
// is blocked, when it has arrived, and by period; so it seldom drives up to a frontier.
//
// A robot that does not move on, or touches something, goes back a little along the way it came, and leaves
// the goal out for a while. Where that happens again and again it trusts the newest scan more than the map,
// on which noise may have hemmed it in. A scan that cannot be used is left out; without any for `blind` the
// robot stands still. When nothing is left to see, or the budget is spent, it goes home. It ends with a stop
// reason:
//   complete  no frontier is left that can be reached and is worth it
//   budget    of time or of distance is spent
//   leak      the map has grown beyond its greatest extent: the world is open
//   stuck     it got stuck too often, or there is no way home
//   lost      it no longer knows where it is
//   blind     no scan came that could be used
// Thread rule: one at a time. Sources: as in the headers named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/jobs/explore/task.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

enum class ExploreStage { seek, go_home, back_off, over };

struct ExploreEvent {
  double time_s = 0.0;
  std::string kind;  ///< goal, home, touch, stuck, loop, end
  std::string text;  ///< one sentence
};

struct ExploreMission {
  ExploreMission(LaserSlam mapping, ExploreTask given);

  /// perceive(), then respond().
  std::optional<Command> step(const Observation& seen);

  ExploreTask task;
  LaserSlam slam;
  FrontierMap frontiers;
  Blacklist blacklist;
  Workspace workspace;

  double time_s = 0.0;
  Pose2 pose;              ///< believed, now; world_T_robot
  Twist2 twist;            ///< by the wheels, lately
  Pose2 odometry;          ///< of the observation before
  Pose2 odometry_of_slam;  ///< of the scan before
  std::optional<double> started_s;
  double scan_s = 0.0;          ///< when the newest scan of use came
  double range_m = 3.5;         ///< of the range finder
  double driven_m = 0.0;        ///< by the wheels
  std::vector<Vec2> beam_ends;  ///< ends of the beams of the newest scan of use, in the world as it was then
  bool touching = false;
  bool looked = false;              ///< a scan came since the last response
  bool wants_settling = false;      ///< with the next scan, SLAM brings all poses to their best
  std::optional<double> settled_m;  ///< driven when it last did, since the goal before
  MapUpdate changed;                ///< of the map, by the newest scan

  ExploreStage stage = ExploreStage::seek;
  Decision decision;  ///< the newest
  std::size_t goal_changes = 0;
  double decided_s = 0.0;
  std::optional<PathProgress> path;
  Pose2 stood;              ///< where it was when it last moved on
  double moved_on_s = 0.0;  ///< when that was

  std::int64_t decisions = 0;
  std::int64_t stuck = 0;       ///< times
  std::int64_t stuck_here = 0;  ///< of these, lately
  double stuck_m = 0.0;         ///< driven at the last
  std::int64_t scans = 0;
  std::int64_t bad_scans = 0;  ///< of these, not of use
  std::int64_t loops = 0;      ///< closed
  std::vector<ExploreEvent> events;
  std::string stop_reason;  ///< once it goes home or has ended
  std::string reason;       ///< a sentence of it
  bool arriving = false;    ///< it has been home as it believed, and explores no more
  bool home = false;        ///< it is back
};

/// Faults: bad_input on a strategy or a planner that there is not.
Outcome<ExploreMission> begin(const ExploreTask& task);

void perceive(ExploreMission& mission, const Observation& seen);
/// The next command, or nothing when the mission is over.
std::optional<Command> respond(ExploreMission& mission);

}  // namespace outrider
