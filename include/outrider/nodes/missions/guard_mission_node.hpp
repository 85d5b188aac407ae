// GuardMissionNode: the mission of the job guard (jobs/guard/mission/mission.hpp) with its robot behind
// topics.
//
//   odom, /tf     where the robot is on the map      ->   cmd_vel
//   joint_states  the joints of the gun                   gun/command   sensor_msgs/JointState: where they
//   gun/hit       which target a ball hit                               have to be
//   scan          what is in the way, if it comes         gun/fire      std_msgs/Float64: one ball, at that
//                                                                       muzzle speed in m/s
//                                                         guard/status  what it does, and how it ended
//                                                         the channels of the run: /targets, /world, ...
//
// Plan, order of the shots and what is done after a miss are those of the job (remote_gun.hpp says what the
// topics of the gun mean). The map is the world of the scenario. All shots are fired from rest: the topics
// tell nothing of when a ball leaves, on which a shot from a moving robot depends. Plans keep `clearance`
// from solids beside the radius, since no robot drives its way exactly.
//
// A shot is answered when its target is told to be hit. If that is not told until `result` after the planned
// landing, there is no result: the mission takes that for a miss, and gives a gun up of which nothing comes
// (jobs/guard/mission/setbacks.hpp). A target that is told to be hit later is not shot at again.
//
// The robot stands while pose, joints or scans are missing that came before, and before what the scan shows
// farther than 0.1 m from every solid of the world. States: waiting, guarding, stopped, done, not_done,
// blocked, stuck, gun_stuck, bad_input.
#pragma once

#include <memory>
#include <optional>

#include "outrider/jobs/guard/mission/mission_log.hpp"
#include "outrider/jobs/guard/run/prepare.hpp"
#include "outrider/nodes/missions/mission_node.hpp"
#include "outrider/nodes/missions/piece_driver.hpp"
#include "outrider/nodes/missions/remote_gun.hpp"
#include "outrider/sim/sensors/range_finder.hpp"

namespace outrider {

struct GuardMissionNodeOptions {
  MissionNodeOptions node;
  double clearance_m = 0.05;        ///< beside the radius, that plans keep from solids
  double result_s = 1.0;            ///< after the planned landing, for which a hit is awaited
  double aimed_rad = radians(0.1);  ///< of both joints, where the gun is aimed
};
std::vector<OptionGroup> describe(GuardMissionNodeOptions& options);

class GuardMissionNode final : public MissionNode {
 public:
  /// Prepares the mission of a scenario that load_problem() has read. Faults: those of check_capabilities()
  /// with `topics` and of prepare_guard().
  static Outcome<std::unique_ptr<PreparedGuard>> prepare(GuardScenario scenario,
                                                         const GuardMissionNodeOptions& options);
  GuardMissionNode(GuardMissionNodeOptions options, std::unique_ptr<PreparedGuard> guard);
  [[nodiscard]] const GuardMission& mission() const { return *mission_; }

 private:
  void act() override;
  [[nodiscard]] std::string why_to_stop() const;
  [[nodiscard]] GunState joints() const { return gun_.joints().value_or(GunState{}); }
  void start(const Pose2& pose);
  void go_on(const Pose2& pose);
  void step(const Pose2& pose);
  void begin_command(const Command& command, const Pose2& pose);
  [[nodiscard]] bool carry_out(const Command& command, const Pose2& pose);
  [[nodiscard]] bool follow(const FollowWaypoints& drive, const Pose2& pose);
  void begin_leg(const FollowWaypoints& drive);
  [[nodiscard]] bool may_drive(const Twist2& twist, const Pose2& pose);
  [[nodiscard]] bool aim(const AimGun& aim, const Pose2& pose);
  [[nodiscard]] bool await(const Fire& fire);
  void note(const Pose2& pose);
  void finish();

  GuardMissionNodeOptions options_;
  std::unique_ptr<PreparedGuard> guard_;
  GuardMission* mission_;  ///< that of guard_, which has one
  RemoteGun gun_;
  RangeFinder solids_;  ///< what is on the map
  LogQueue queue_;
  std::unique_ptr<TargetLog> run_log_;
  std::optional<Command> present_;  ///< what the robot does
  double began_command_s_ = 0.0;
  PieceDriver driver_;
  std::size_t leg_ = 0;           ///< waypoint to which it drives
  std::optional<double> rest_s_;  ///< since when it stands at the end of its drive
  Vec2 stood_;                    ///< where it last got on
  double moved_on_s_ = 0.0;
  bool stands_ = false;              ///< before something that the scan shows
  std::vector<Vec2> unmapped_;       ///< what the newest scan shows beside the solids, on the map
  std::vector<ShotResult> results_;  ///< that the mission has not seen
  double noted_s_ = -1e9;            ///< when pose and joints were logged
  int shots_ = 0;                    ///< that were sent to the gun
  std::size_t aim_output_, fire_output_;
};

}  // namespace outrider
