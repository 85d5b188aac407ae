// ExploreMission executes an exploration: a pure step from the observations of a robot with a range finder to
// the twist that it commands.
//
// perceive() processes an observation: SLAM matches each scan, and odometry updates the pose between scans.
// respond() updates the frontiers, decides on a goal (explore/decide.hpp) and steers to it
// (control/steer.hpp). It decides again when the pursued frontier has dissolved, when the path is blocked,
// when the robot has arrived, and periodically; so the robot seldom drives all the way to a frontier.
//
// A robot that makes no progress, or touches something, backs off along its path and bans the goal for a
// while. If that happens repeatedly, it trusts the newest scan more than the map, in which noise may have
// enclosed the robot. Unusable scans are skipped; without any usable scan for `blind_s` the robot stops. When
// nothing is left to see, or the budget is spent, it drives home. The mission ends with a stop reason:
//   complete  no reachable frontier with enough unknown area is left
//   budget    the limit of time or distance is reached
//   leak      the map exceeds its largest extent: the world is open
//   stuck     the robot got stuck too often, or there is no path home
//   lost      the robot no longer knows its pose
//   blind     no usable scan came
// Thread rule: one at a time. Sources: as in the headers named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/jobs/explore/task.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

/// What the robot does now.
enum class ExploreStage { seek, go_home, back_off, over };

/// An event of the mission.
struct ExploreEvent {
  double time_s = 0.0;
  std::string kind;  ///< goal, home, touch, stuck, loop, end
  std::string text;  ///< one sentence
};

/// The state of the execution.
struct ExploreMission {
  ExploreMission(LaserSlam mapping, ExploreTask given);

  /// Calls perceive(), then respond().
  std::optional<Command> step(const Observation& seen);

  ExploreTask task;
  LaserSlam slam;
  FrontierMap frontiers;
  Blacklist blacklist;
  Workspace workspace;

  double time_s = 0.0;
  Pose2 pose;              ///< believed current pose, world_T_robot
  Twist2 twist;            ///< recent velocity by odometry
  Pose2 odometry;          ///< odometry of the previous observation
  Pose2 odometry_of_slam;  ///< odometry of the previous scan
  std::optional<double> started_s;
  double scan_s = 0.0;          ///< time of the newest usable scan
  double range_m = 3.5;         ///< of the range finder
  double driven_m = 0.0;        ///< distance by odometry
  std::vector<Vec2> beam_ends;  ///< beam ends of the newest usable scan, in the world frame of that time
  bool touching = false;
  bool looked = false;              ///< a scan arrived since the last response
  bool wants_settling = false;      ///< SLAM optimises all poses with the next scan
  std::optional<double> settled_m;  ///< driven_m at the last optimisation, since the previous goal
  MapUpdate changed;                ///< changes of the map by the newest scan

  ExploreStage stage = ExploreStage::seek;
  Decision decision;  ///< newest decision
  std::size_t goal_changes = 0;
  double decided_s = 0.0;
  std::optional<PathProgress> path;
  Pose2 stood;              ///< pose of the last progress
  double moved_on_s = 0.0;  ///< time of the last progress

  std::int64_t decisions = 0;
  std::int64_t stuck = 0;       ///< how often the robot got stuck
  std::int64_t stuck_here = 0;  ///< how often recently
  double stuck_m = 0.0;         ///< driven_m at the last time
  std::int64_t scans = 0;
  std::int64_t bad_scans = 0;  ///< unusable scans
  std::int64_t loops = 0;      ///< closed loops
  std::vector<ExploreEvent> events;
  std::string stop_reason;  ///< set once the robot drives home or has ended
  std::string reason;       ///< the stop reason as a sentence
  bool arriving = false;    ///< the robot was home by its belief, and explores no more
  bool home = false;        ///< the robot is home
};

/// Starts a mission. Faults: bad_input on an unknown strategy or planner.
Outcome<ExploreMission> begin(const ExploreTask& task);

/// Processes an observation.
void perceive(ExploreMission& mission, const Observation& seen);
/// Returns the next command, or nothing if the mission is over.
std::optional<Command> respond(ExploreMission& mission);

}  // namespace outrider
