// PursueMissionNode: the mission of the job pursue (jobs/pursue/mission.hpp) with its robot behind topics.
//
//   odom, /tf    where the robot is on the map              ->   cmd_vel
//   target_pose  geometry_msgs/PoseStamped: who is pursued       pursue/status  what it does, and how it
//   ended
//                                                                the channels of the run: /paid, /pose, ...
//
// The grid of costs is that of the scenario, each cell `cell` wide, the lower left corner of the first at the
// origin of the map. Its target tells only for how many seconds it is there; where it is comes on the topic,
// and where it will be from the forecast. A second of the mission takes `second`: so long the robot has for
// the way to the next cell. If it is not there by then, it plans anew from where it is. One robot pursues;
// its start is where it stands.
//
// The robot stands before what the newest scan shows in its way (in_the_way.hpp) that is neither off the map,
// nor within 0.1 m of a cell that cannot be entered, nor within the width of a cell of the target. The
// seconds of the mission pass meanwhile. States: waiting, pursuing, stopped, blocked, caught, not_caught, or
// the fault of the planner.
#pragma once

#include <memory>
#include <optional>

#include "outrider/jobs/pursue/report.hpp"
#include "outrider/jobs/pursue/scenario.hpp"
#include "outrider/nodes/missions/mission_node.hpp"
#include "outrider/nodes/missions/piece_driver.hpp"

namespace outrider {

struct PursueMissionNodeOptions {
  MissionNodeOptions node;
  double cell_m = 1.0;    ///< side of a cell
  double second_s = 1.0;  ///< duration of a second of the mission
  double radius_m = 0.2;  ///< of a disk that contains the robot, with which it stops before things
  Pace pace;              ///< how fast the robot drives

  PursueMissionNodeOptions();
};
std::vector<OptionGroup> describe(PursueMissionNodeOptions& options);

class PursueMissionNode final : public MissionNode {
 public:
  /// Fault: bad_input for a team, which one robot is not.
  static Status check(const PursuitScenario& scenario, const PursuitTask& task);
  PursueMissionNode(PursueMissionNodeOptions options, PursuitTask task, const std::string& name);
  ~PursueMissionNode() override;

 private:
  class Clock;

  Status take_target(const geometry_msgs::PoseStamped& target);
  void act() override;
  [[nodiscard]] std::string why_to_stop() const;
  [[nodiscard]] Cell cell_of(Vec2 point) const;
  void begin(Cell robot);
  void step(const Pose2& pose);
  void drive(const Pose2& pose);
  [[nodiscard]] bool is_unmapped(Vec2 point) const;
  void finish();

  PursueMissionNodeOptions options_;
  PursuitTask task_;
  std::string name_;
  NewestStamp targets_;
  std::optional<Vec2> target_;
  double target_came_s_ = 0.0;
  std::unique_ptr<Clock> clock_;
  std::unique_ptr<PursuitMission> mission_;
  std::unique_ptr<PursuitLog> run_log_;
  PieceDriver driver_;
  std::vector<Vec2> unmapped_;  ///< what the newest scan shows beside the map
  std::size_t seconds_ = 0;     ///< that the mission has seen
  double next_s_ = 0.0;         ///< when the next one ends
};

}  // namespace outrider
