// ExploreMission executes an exploration: a pure step from the observations of a robot with a range finder to
// the twist that its navigator commands.
//
// perceive() processes an observation: the localiser follows the robot (scan_localiser.hpp). respond()
// updates the frontiers, decides on a goal (choose/decide.hpp) and orders the navigator along the way. It
// decides again when the pursued frontier has dissolved, when the path is blocked, when the robot has
// arrived, and periodically; so the robot seldom drives all the way to a frontier.
//
// The navigator (navigate/navigator.hpp) gets it there and recovers; its localiser is that of the mission, so
// there is one pose. Where it gives up, or stands for too long, the goal is banned for a while. Where the
// robot touched something the ground stays blocked, also if the laser sees nothing there. Where it has
// driven, the ground stays open, whatever noise does to the map. Without any usable scan that is younger than
// `blind_s` the robot stops; it does not drive by what it saw longer ago.
//
// When nothing is left to see on ground that the map calls wide enough, the robot tries the passages in which
// it may fit all the same: it drives up to them, measures the gap (close_range.hpp), and passes it or notes
// its width. When nothing is left to see or to try, or the budget is spent, it drives home.
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

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/planner_outage.hpp"
#include "outrider/jobs/explore/choose/left_over.hpp"
#include "outrider/jobs/explore/mission/gap_passage.hpp"
#include "outrider/jobs/explore/mission/scan_localiser.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/jobs/explore/mission/touch_marks.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

/// The activity of the robot.
enum class ExploreStage { seek, go_home, over };

/// An event of the mission.
struct ExploreEvent {
  double time_s = 0.0;
  std::string kind;  ///< goal, home, touch, stuck, narrow, loop, end
  std::string text;  ///< one sentence
};

class ExploreMission {
 public:
  /// Use begin(), which checks the task.
  ExploreMission(ExploreTask task, PlannerOutage outage, ScanLocaliser& where, Navigator navigator);

  /// Processes an observation.
  void perceive(const Observation& seen);
  /// Returns the next command, or nothing if the mission is over.
  std::optional<Command> respond();
  /// Calls perceive(), then respond().
  std::optional<Command> step(const Observation& seen);

  [[nodiscard]] const ExploreTask& task() const { return task_; }
  [[nodiscard]] const ScanLocaliser& where() const { return *where_; }
  [[nodiscard]] const FrontierMap& frontiers() const { return frontiers_; }
  [[nodiscard]] ExploreStage stage() const { return stage_; }
  [[nodiscard]] const Decision& decision() const { return decision_; }  ///< the newest one
  [[nodiscard]] std::int64_t decisions() const { return decisions_; }
  [[nodiscard]] std::size_t goal_changes() const { return goal_changes_; }
  [[nodiscard]] const std::optional<PathProgress>& path() const { return path_; }
  [[nodiscard]] const std::vector<ExploreEvent>& events() const { return events_; }
  [[nodiscard]] const LeftOvers& left() const { return left_; }
  [[nodiscard]] const std::vector<Vec2>& touched() const { return touches_.points(); }
  [[nodiscard]] std::int64_t stuck() const { return stuck_; }  ///< how often it got stuck
  [[nodiscard]] std::int64_t loops() const { return loops_; }  ///< closed loops
  /// Returns the stop reason, set once the robot drives home or has ended, and the same as a sentence.
  [[nodiscard]] const std::string& stop_reason() const { return stop_reason_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] bool is_home() const { return home_.is_there; }
  /// Returns the share of points at home by which the first and the last scan contradict each other.
  [[nodiscard]] double home_contradiction() const { return home_.contradiction; }
  /// Returns the map of SLAM with all cells that the robot has seen to be free. SLAM draws its map anew from
  /// the scans that it keeps, and what only others saw would be lost; it is kept unless the poses were
  /// corrected by more than two cells. O(cells).
  [[nodiscard]] Grid<std::uint8_t> explored_map() const;

 private:
  static constexpr double no_way_m = std::numeric_limits<double>::infinity();

  void add_event(std::string kind, std::string text);
  void end(std::string stop_reason, std::string reason);
  void follow(std::vector<Vec2> points);
  [[nodiscard]] ExploreState state();
  /// Returns the distance from the end of its path at which the robot is there.
  [[nodiscard]] double arrived_m() const { return std::min(0.05, 0.5 * task_.rules.home_within_m); }

  // mission.cpp: what it learns, and how it ends
  void note_new_ground();
  void update_frontiers();
  bool believes_range_finder();
  [[nodiscard]] std::string why_blind(double blind_s) const;
  std::string home_doubt();
  void judge_what_is_left();

  // mission_goal.cpp: where it goes
  bool settled(double lately_m);
  [[nodiscard]] std::vector<Vec2> trail_home() const;
  void turn_home(const std::string& stop_reason, const std::string& reason);
  [[nodiscard]] std::pair<std::string, std::string> verdict() const;
  void nothing_to_reach();
  void take(Decision decision);
  [[nodiscard]] bool spent() const;
  [[nodiscard]] bool explored() const;
  bool opens_narrow_way(bool beside);
  Outcome<Decision> decide_with_tries();
  bool goes_out_again();
  void go_without_planner(const Fault& fault);
  [[nodiscard]] bool sees_nothing_new() const;
  void decide_anew();

  // mission_drive.cpp: how it drives there
  [[nodiscard]] bool time_to_decide() const;
  bool stands_still();
  void give_up_goal(const std::string& why);
  void too_narrow();
  void end_if_no_nearer_to_home();
  void look_close();
  [[nodiscard]] GoTo next_order(const PathProgress& path) const;
  Order drive();

  /// The way home.
  struct Home {
    /// Least way that was left since the last goal, by plan and on the trail, m.
    std::array<double, 2> left_m = {no_way_m, no_way_m};
    double nearer_s = 0.0;  ///< time at which one of them last became less
    bool on_trail = false;  ///< it drives along its trail, since the map shows no way
    bool arriving = false;  ///< the robot was home by its belief; it goes out again twice at most
    int returns = 0;        ///< how often it found at home that something was left to see, and went out again
    bool is_there = false;  ///< the robot is home
    double contradiction = 0.0;
  };

  ExploreTask task_;
  PlannerOutage outage_;  ///< a fault to try out: a planner without a budget
  Navigator navigator_;
  ScanLocaliser* where_;  ///< that of the navigator
  FrontierMap frontiers_;
  TouchMarks touches_;
  GapPassage gaps_;
  Home home_;
  Blacklist blacklist_;
  Workspace workspace_;

  bool touching_ = false;
  double sighted_s_ = 0.0;  ///< last time at which the newest scan was young enough to drive
  bool forgets_ = false;    ///< poses were corrected by much: what was seen is only what the map has
  double known_m2_ = 0.0;   ///< largest area of known ground so far
  double learned_s_ = 0.0;  ///< time at which that was last noticed to grow
  std::int64_t loops_ = 0;

  ExploreStage stage_ = ExploreStage::seek;
  Decision decision_;
  std::int64_t decisions_ = 0;
  std::size_t goal_changes_ = 0;
  double decided_s_ = 0.0;
  std::optional<double> planless_s_;  ///< time since which its planner has had no budget
  std::optional<PathProgress> path_;
  std::optional<GoTo> order_;      ///< the newest one
  std::optional<Follow> through_;  ///< the same in narrow places
  Situation now_;
  std::int64_t stuck_ = 0;       ///< how often the robot got stuck
  std::int64_t stuck_here_ = 0;  ///< how often in a row
  double stuck_m_ = 0.0;         ///< distance driven at the last time
  Pose2 stood_;                  ///< pose of the last progress
  double moved_on_s_ = 0.0;      ///< its time
  LeftOvers left_;               ///< as of `left_s_`
  double left_s_ = -1.0;
  std::vector<ExploreEvent> events_;
  std::string stop_reason_, reason_;
};

/// Starts a mission. Faults: bad_input on an unknown strategy or planner.
Outcome<ExploreMission> begin(const ExploreTask& task, const PlannerOutage& outage = {});

}  // namespace outrider
