// CoverMissionNode: the mission of the job cover (jobs/cover/mission/mission.hpp) with its robot behind
// topics.
//
//   odom, /tf  where the robot is on the map   ->   cmd_vel
//   scan       what is in the way, if it comes      cover/status  what it does, and what it has covered
//                                                   the channels of the run, as docs/jobs/cover.md has them
//
// The area is in metres of the map. The track is planned and proven once it is known where the robot is: it
// begins there, unless the scenario says where; then the robot must stand within 0.3 m of it. Pieces are
// driven by piece_driver.hpp. It stands still while odometry or pose is older than its patience; and if a
// scan has ever come, while that is, or while the newest shows something in the way (in_the_way.hpp) that is
// more than 0.1 m inside of the area: what is nearer to a border, or beyond it, is taken for what the map has
// there. At the end what the robot drove, by its own pose, is measured as the simulated drive of the job is.
// States: waiting, covering, stopped, done, not_done, stuck, blocked, or the fault of the planner.
#pragma once

#include <memory>
#include <optional>

#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/jobs/cover/report.hpp"
#include "outrider/jobs/cover/scenario.hpp"
#include "outrider/nodes/missions/mission_node.hpp"
#include "outrider/nodes/missions/piece_driver.hpp"

namespace outrider {

class CoverMissionNode final : public MissionNode {
 public:
  /// Fault: those of load_task(), and bad_input for an area in degrees, which no map is in.
  static Status check(const CoverScenario& scenario);
  CoverMissionNode(MissionNodeOptions options, CoverScenario scenario);

  [[nodiscard]] const PieceDrive& drive() const { return drive_; }

 private:
  /// The task, plan and mission, which are made once the pose of the robot is known.
  struct Work;

  void act() override;
  Status begin(const Pose2& pose);
  void go_on(const Pose2& pose);
  void note_unmapped();
  void note(const Pose2& pose);
  void finish();

  CoverScenario scenario_;
  std::shared_ptr<Work> work_;
  PieceDrive drive_;
  std::vector<Vec2>
      unmapped_;  ///< what the newest scan shows and the map does not have, in the frame of the area
  double moved_on_s_ = 0.0;  ///< when it last got on
  Vec2 stood_;
};

}  // namespace outrider
