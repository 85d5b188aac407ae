// ExploreMission executes an exploration: a pure step from the observations of a robot with a range finder to
// the twist that it commands.
//
// perceive() processes an observation: SLAM matches each scan, and odometry updates the pose between scans.
// respond() updates the frontiers, decides on a goal (explore/decide.hpp) and steers to it
// (control/steer.hpp). It decides again when the pursued frontier has dissolved, when the path is blocked,
// when the robot has arrived, and periodically; so the robot seldom drives all the way to a frontier.
//
// A robot that makes no progress, or touches something, backs off along its path, and if that does not help
// to where there is most room; where it touched nothing it bans the goal for a while. Where it touched
// something the ground stays blocked, also if the laser sees nothing there. Where it has driven, the ground
// stays open, whatever noise does to the map. If it gets stuck repeatedly, it trusts the newest scan more
// than the map. Unusable scans are skipped, as are those that repeat the ranges of before after a motion,
// which a sensor does that is frozen. A scan belongs to where the robot was when it was measured, so one that
// comes late is matched there. Without any usable scan that is younger than `blind_s` the robot stops; it
// does not drive by what it saw longer ago.
//
// When nothing is left to see on ground that the map calls wide enough, the robot tries the passages in which
// it may fit all the same: it drives up to them, measures the gap (close_range.hpp), and passes through its
// middle or notes its width. When nothing is left to see or to try, or the budget is spent, it drives home.
// The mission ends with a stop reason:
//   complete  nothing is left over (left_over.hpp)
//   left_over something is left over that the robot cannot see; the reason says how much, and why
//   budget    the limit of time or distance is reached
//   leak      the map exceeds its largest extent: the world is open
//   stuck     the robot got stuck too often, there is no path home, it got no nearer to home for 120 s, it
//             saw nothing new for 200 s and two drives across its map, or its planner ran out of its budget
//   lost      the robot no longer knows its pose, its map cannot be believed (map_doubt.hpp), or what it sees
//             at home is not what it saw there first: it may have been carried away
//   blind     no usable scan came
// Thread rule: one at a time. Sources: as in the headers named.
#pragma once

#include <array>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/planner_outage.hpp"
#include "outrider/jobs/explore/close_range.hpp"
#include "outrider/jobs/explore/left_over.hpp"
#include "outrider/jobs/explore/task.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/slam/repeated_scans.hpp"

namespace outrider {

/// The present activity of the robot.
enum class ExploreStage { seek, go_home, back_off, over };

/// An event of the mission.
struct ExploreEvent {
  double time_s = 0.0;
  std::string kind;  ///< goal, home, touch, stuck, narrow, loop, end
  std::string text;  ///< one sentence
};

/// The odometry at a time.
struct TimedOdometry {
  double time_s = 0.0;
  Pose2 odometry;
};

/// A point at which the robot touched something.
struct TouchedPoint {
  std::int64_t scan = 0;  ///< number of scans before
  Vec2 point;             ///< in the frame of the robot at the newest of these scans
};

/// The state of the execution.
struct ExploreMission {
  static constexpr double no_way_m = std::numeric_limits<double>::infinity();

  ExploreMission(LaserSlam mapping, ExploreTask given);

  /// Calls perceive(), then respond().
  std::optional<Command> step(const Observation& seen);

  ExploreTask task;
  LaserSlam slam;
  FrontierMap frontiers;
  Blacklist blacklist;
  Workspace workspace;

  double time_s = 0.0;
  Pose2 pose;                            ///< believed current pose, world_T_robot
  Twist2 twist;                          ///< recent velocity by odometry
  Pose2 odometry;                        ///< odometry of the previous observation
  Pose2 odometry_of_slam;                ///< odometry when the previous scan was measured
  std::deque<TimedOdometry> odometries;  ///< of the last seconds, for scans that come late
  std::optional<double> started_s;
  double scan_s = 0.0;                  ///< time at which the newest usable scan was measured
  double sighted_s = 0.0;               ///< last time at which that was lately enough to drive
  double range_m = 3.5;                 ///< of the range finder
  double driven_m = 0.0;                ///< distance by odometry
  std::optional<LaserScan> first_scan;  ///< first usable scan
  std::optional<LaserScan> last_scan;   ///< newest usable scan
  std::size_t first_step = 0;           ///< their numbers in the trajectory
  std::size_t last_step = 0;
  double home_contradiction = 0.0;  ///< share of the points at home in which these two contradict each other
  RepeatedScans repeated;           ///< scans of a frozen sensor
  std::vector<Vec2> beam_ends;      ///< beam ends of the newest usable scan, in the world frame of that time
  CloseRange close_range;
  bool touching = false;
  bool new_touch = false;             ///< it has just touched something that was not touched before
  bool backwards = false;             ///< it drives backwards while it backs off
  std::vector<Vec2> contacts;         ///< where it touched something, in the world of that time
  std::vector<TouchedPoint> touches;  ///< the obstacles that it takes to be there
  std::vector<Vec2> touched;          ///< the same in the world, by the newest estimate
  std::optional<Pose2> trail_end;     ///< pose up to which the driven trail is marked on the ground
  bool forget_seen = false;         ///< poses were corrected by much: what was seen is only what the map has
  bool marks_moved = false;         ///< the map was redrawn: trail and touches have to be marked anew
  bool looked = false;              ///< a scan arrived since the last response
  bool wants_settling = false;      ///< SLAM optimises all poses with the next scan
  std::optional<double> settled_m;  ///< driven_m at the last optimisation, since the previous goal
  MapUpdate changed;                ///< changes of the map by the newest scan

  ExploreStage stage = ExploreStage::seek;
  Decision decision;  ///< newest decision
  std::size_t goal_changes = 0;
  double decided_s = 0.0;
  double known_m2 = 0.0;             ///< largest area of known ground so far
  double learned_s = 0.0;            ///< time at which that was last noticed to grow
  PlannerOutage outage;              ///< a fault to try out: a planner without a budget; none by default
  std::optional<double> planless_s;  ///< time since which its planner has had no budget
  std::optional<PathProgress> path;
  std::int64_t centred_scan = -1;   ///< value of `scans` when the path was last centred; -1: the path is new
  std::optional<PathRoom> room;     ///< set while the path leads through narrow places
  Nearby surfaces;                  ///< of close_range, while `room` is set
  bool fits = true;                 ///< false: `room` is surely too little, and the robot stands
  GapLooks looks;                   ///< at the narrowest place ahead, from a distance
  std::vector<NarrowPlace> narrow;  ///< places that were found to be too narrow, or tried
  LeftOvers left;                   ///< as of `left_s`
  double left_s = -1.0;
  Pose2 stood;              ///< pose of the last progress
  double moved_on_s = 0.0;  ///< time of the last progress

  std::int64_t decisions = 0;
  std::int64_t stuck = 0;       ///< how often the robot got stuck
  std::int64_t stuck_here = 0;  ///< how often recently
  double stuck_m = 0.0;         ///< driven_m at the last time
  std::int64_t scans = 0;
  std::int64_t bad_scans = 0;                ///< unusable scans
  std::int64_t range_finder_asked_at = 250;  ///< value of `scans` at which the range finder is checked
  std::int64_t loops = 0;                    ///< closed loops
  std::vector<ExploreEvent> events;
  std::string stop_reason;  ///< set once the robot drives home or has ended
  std::string reason;       ///< the stop reason as a sentence
  /// Least way home that was left since the last goal, by plan and on the trail, m.
  std::array<double, 2> home_left_m = {no_way_m, no_way_m};
  double nearer_home_s = 0.0;  ///< time at which one of them last became less
  bool on_trail = false;       ///< it drives home along its trail, since the map shows no way
  bool arriving = false;       ///< the robot was home by its belief; it goes out again twice at most
  int returns = 0;    ///< how often it found at home that something was left to see, and went out again
  bool home = false;  ///< the robot is home
};

/// Starts a mission. Faults: bad_input on an unknown strategy or planner.
Outcome<ExploreMission> begin(const ExploreTask& task);

/// Returns the map of SLAM with all cells that the robot has seen to be free. SLAM draws its map anew from
/// the scans that it keeps, and what only others saw would be lost; it is kept unless the poses were
/// corrected by more than two cells. O(cells).
Grid<std::uint8_t> explored_map(const ExploreMission& mission);

/// Processes an observation.
void perceive(ExploreMission& mission, const Observation& seen);
/// Returns the next command, or nothing if the mission is over.
std::optional<Command> respond(ExploreMission& mission);

}  // namespace outrider
