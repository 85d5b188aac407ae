// ExplorerNode: chooses where to go next so that everything that can be seen is mapped, then goes home.
//
//   map             nav_msgs/OccupancyGrid    ->   goal_pose       geometry_msgs/PoseStamped
//   scan            sensor_msgs/LaserScan          frontiers       visualization_msgs/MarkerArray
//   /tf, /tf_static                                explore/status  what it does, and why it ended
//   mapper/status   diagnostic_msgs/DiagnosticStatus
//
// Goals are those of jobs/explore/choose/decide.hpp, chosen again with every map. A goal at which the robot
// stood without seeing what it was to see there, or to which it makes no way for `patience`, is left alone
// for a while. Narrow ways on which the robot may fit, as far as the map tells, are looked at from near,
// since the noise of the scans makes many; the robot does not pass them. If scans come, their width is
// measured there (gap_measure.hpp).
//
// The exploration is complete if nothing is left over (jobs/explore/choose/left_over.hpp) but what lies
// behind gaps that were measured to be too narrow for the robot with its clearance, the radius and
// `explore.margin` on each side, or that are so on the map though its walls may be drawn too thick. Without
// scans no gap is measured. It is not called complete if the mapper doubts its map, for which it is asked in
// the end; the sentence says if no mapper answers. States: exploring, going_home, asking, complete,
// left_over, lost, leak, stuck, map_lost. The sentence of an end says what is left over or behind gaps, or
// why. A goal is sent again every second, since messages get lost.
#pragma once

#include <optional>
#include <string>

#include "outrider/jobs/explore/choose/decide.hpp"
#include "outrider/jobs/explore/choose/left_over.hpp"
#include "outrider/nodes/gap_measure.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"

namespace outrider {

struct ExplorerNodeOptions {
  FrameNames frames;
  std::string home;  ///< "x,y,heading" on the map, in m and degrees; empty: where the robot is at first
  bool return_home = true;
  double home_within_m = 0.1;        ///< distance at which the robot is home
  double range_m = 3.5;              ///< of the range finder
  double patience_s = 10.0;          ///< time without moving on after which a goal has failed
  double look_s = 2.5;               ///< time that the robot stands at a goal before that has failed
  std::int64_t most_failures = 100;  ///< goals that fail before it goes home
  RobotModel robot;
  ExploreOptions explore;

  ExplorerNodeOptions();
};
std::vector<OptionGroup> describe(ExplorerNodeOptions& options);

class ExplorerNode final : public Node {
 public:
  /// Fault: bad_input for a home that is none.
  static Outcome<ExplorerNodeOptions> checked(ExplorerNodeOptions options);
  explicit ExplorerNode(ExplorerNodeOptions options);
  [[nodiscard]] bool is_over() const override { return over_; }

 private:
  Status take_map(const nav_msgs::OccupancyGrid& map);
  Status take_scan(const sensor_msgs::LaserScan& scan);
  Status take_verdict(const diagnostic_msgs::DiagnosticStatus& mapper);
  void act() override;
  void decide_anew();
  void decide_where(const Decision& decision);
  Outcome<Decision> decision_with_tries();
  void nothing_to_reach(const Decision& decision);
  [[nodiscard]] double wanted_room_m() const;
  void judge_goal();
  void moved_on();
  void go_home(std::string state, std::string sentence);
  void end();
  void end_as_judged();
  [[nodiscard]] bool has_explored() const;
  void send_goal();
  void send_frontiers();
  [[nodiscard]] ExploreState state();

  ExplorerNodeOptions options_;
  RobotFrames frames_;
  NewestStamp maps_;
  MapBeginning beginning_;
  ScanPoints scan_;
  GapMeasure gap_;
  FrontierMap frontiers_;
  Blacklist blacklist_;
  Workspace workspace_;
  GridFrame frame_;  ///< of the newest map
  bool has_map_ = false, new_map_ = false;
  Pose2 pose_;
  std::optional<Pose2> home_;
  std::optional<Decision> decision_;
  std::optional<Pose2> goal_;
  double goal_sent_s_ = -1e9;
  Pose2 stood_;  ///< pose of the last progress
  double moved_on_s_ = 0.0;
  std::optional<double> arrived_s_;  ///< when the robot came to its goal
  std::int64_t failures_ = 0;
  std::vector<NarrowPlace> narrow_;       ///< narrow places that it has looked at
  std::optional<NarrowWay> narrow_way_;   ///< that it goes to look at
  std::string end_state_, end_sentence_;  ///< set once it goes home
  std::optional<std::string> doubt_;      ///< of the mapper about its map, once it has said anything
  std::optional<double> asked_s_;         ///< when it began to wait for the verdict of the mapper
  bool over_ = false;
  std::size_t goal_output_, frontier_output_;
};

}  // namespace outrider
