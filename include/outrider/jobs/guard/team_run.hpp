// run_team(): simulates the mission of several guard robots that share the targets.
//
// Always the robot with the earliest clock is stepped. It does what a single robot does (stop_tasks.hpp), but
// before a drive it waits until the whole drive, and standing at its end for ever, keeps team_gap_m() from
// all drives that were admitted before, with the largest error of its end. So true motions keep apart by the
// sum of the radii, whatever the errors. If nobody can drive any more, the targets of the first robot's
// present stop fail, and it goes on with the next one.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "outrider/jobs/guard/closest_approach.hpp"
#include "outrider/jobs/guard/stop_tasks.hpp"
#include "outrider/jobs/guard/team_plan.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// What a team did.
struct TeamRun {
  std::vector<TargetRecord> records;  ///< by target
  std::vector<TimedDrives> driven;    ///< by robot: the true ways
  std::vector<Log> logs;              ///< by robot, as that of a single one
  double mission_s = 0.0;             ///< the last robot is done
  double waited_s = 0.0;              ///< sum of the waits for other robots
  std::size_t given_up = 0;           ///< stops that another robot kept from being made
  bool ended_early = false;           ///< by the stop token
};

/// Carries the plan out. The times of the plan are not kept to: errors and repeated shots change them. The
/// errors of robot r are drawn from the seed's stream "robot r" as those of a single robot. Deterministic.
TeamRun run_team(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& plan,
                 std::uint64_t seed, const std::stop_token& stop = {});

}  // namespace outrider
