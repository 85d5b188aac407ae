// The log and the report of a guard mission of several robots.
#pragma once

#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/guard/team/team_run.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Appends what the robots logged, and what became of the targets, to one log, in the order of time; at one
/// time, in that of the robots. The first robot keeps its topics, with transforms. Poses, joints and plans of
/// the others have a prefix, as in /robot_2/pose. Shots and events of all are on the same topics; an event
/// begins with its robot, as in "robot 2: ". O(messages log messages).
void append_team(Log& log, const TeamRun& team);

/// Returns the result of a team. `log` holds its shots. Its status is "done" if every target that can be hit
/// was hit and closest_approach() finds that no two bodies overlapped at any time. Metrics are those of a
/// still yard (run.hpp) without the ones of the tour, with the makespans for the times, and robots, alone_s,
/// waited_s, given_up, stopped_balls and closest_m; the table `robots` has a row for each robot.
Report judge_team(const GuardScenario& scenario, const FiringMap& firing_map, const TeamPlan& plan,
                  const TeamRun& team, const Log& log);

}  // namespace outrider
