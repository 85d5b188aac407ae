// A robot of a team that is simulated, with its mission.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/jobs/guard/run/robot.hpp"
#include "outrider/jobs/guard/team/team_run.hpp"
#include "run/guard_log.hpp"
#include "team/team_schedule.hpp"

namespace outrider {

/// A robot of the team with its mission. It is made in place and never moved.
struct TeamRobot {
  TeamRobot(const GuardProblem& team, const FiringMap& firing_map, const GuardSimParams& faults,
            const TeamPart& part, std::size_t number, std::uint64_t seed)
      : problem(started_at(team, part.start)),
        index(number),
        mission(problem, firing_map, part.plan),
        targets(run.targets, queue, team.targets),
        robot(simulated_guard(problem, firing_map, run.log, seed, {}, {}, faults)),
        present{standing(part.start.position, 0.0)} {
    run.driven.start = part.start;
  }

  static GuardProblem started_at(GuardProblem problem, const Pose2& start) {
    problem.start = start;
    return problem;
  }

  GuardProblem problem;  // with its own start
  std::size_t index;     // among the robots
  GuardMission mission;
  TeamRobotRun run;
  LogQueue queue;
  TargetLog targets;
  SimulatedRobot robot;
  std::vector<Presence> present;  // as admitted
  double stays_until_s = 0.0;     // a ball touches it where it stands then
  bool done = false;
  bool refused = false;  // its next command was, since anybody did anything else
  bool waits = false;    // its newest command was a wait for others
};

}  // namespace outrider
