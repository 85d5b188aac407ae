// run_team(): simulates the mission of several guard robots that share the targets.
//
// Always the robot with the earliest clock is stepped. It does what a single robot does (task_board.hpp), but
// before a drive it waits until the whole drive, and standing at its end for ever, keeps simulated_gap_m()
// from all drives that were admitted before, with the largest error of its end. So true motions keep apart by
// the sum of the radii, whatever the errors that the problem tells of. If nobody can drive any more, the
// first robot looks for a way around those that stand; if there is none, the targets of its present stop
// fail, and it goes on with the next one.
//
// A ball that touches the body of another robot, a cylinder, is stopped there and has missed. So a robot does
// not shoot while the planned flight would come near another one, and does not drive into the flight of a
// ball in the air. If nobody can do anything any more, a shot from rest that another robot stands in the way
// of is given up, and a drive begins in spite of the shots in passing that are stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/mission/task_board.hpp"
#include "outrider/jobs/guard/team/team_plan.hpp"
#include "outrider/log/log.hpp"
#include "outrider/motion/closest_approach.hpp"
#include "outrider/sim/faults/guard_sim_params.hpp"
#include "outrider/sim/record.hpp"

namespace outrider {

/// The run of one robot of a team.
struct TeamRobotRun {
  TimedDrives driven;     ///< its true ways
  Log log;                ///< as that of a single robot, without the targets
  Log targets;            ///< what became of its targets; the others wait
  SimRecord record;       ///< what it drove and how often it shot
  double end_s = 0.0;     ///< it is done
  double waited_s = 0.0;  ///< for other robots
};

/// The run of a team.
struct TeamRun {
  std::vector<TargetRecord> records;  ///< by target
  std::vector<std::size_t> robot_of;  ///< by target: the robot that the target was left to; the first if none
  std::vector<TeamRobotRun> robots;
  double mission_s = 0.0;    ///< the last robot is done
  double waited_s = 0.0;     ///< sum of the waits for other robots
  std::size_t given_up = 0;  ///< stops and shots that another robot kept from being made
  std::size_t stopped = 0;   ///< balls that touched another robot
  bool ended_early = false;  ///< by the stop token
};

/// Carries the plan out. The times of the plan are not kept to: errors and repeated shots change them. The
/// errors of robot r are drawn from the seed's stream "robot r" as those of a single robot, and each robot
/// has the faults, of which the mission knows nothing. Deterministic.
TeamRun run_team(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& plan,
                 std::uint64_t seed, const RunWatch& watch = {}, const GuardSimParams& faults = {});

}  // namespace outrider
