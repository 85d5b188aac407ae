// One log of a team, out of the logs of its robots.
#pragma once

#include <vector>

#include "outrider/jobs/guard/team/team_run.hpp"

namespace outrider {

/// Appends what the robots logged, and what became of the targets, to one log, in the order of time; at one
/// time, in that of the robots. The first robot keeps its topics, with transforms. Poses, joints and plans of
/// the others have a prefix, as in /robot_2/pose. Shots and events of all are on the same topics; an event
/// begins with its robot, as in "robot 2: ". O(messages log messages).
void append_team(Log& log, const TeamRun& team);

}  // namespace outrider
