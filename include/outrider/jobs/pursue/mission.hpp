// The execution of a pursuit: a pure step, one call of the planner and the seconds that it costs.
//
// Accounting, as the reference's test bench counts: a call of less than 2 s costs one second, of 2 to 3 s
// two, and so on; each second charges the cell in which the robot was before it; the catch is tested
// after each second, second 0 does not count, and the last that does is that of the target's last cell.
//
// While the planner thinks, the robot goes on along the way it has. What a call brings is taken up where
// the robot is or will be on that way (the splice), and only if the catch that it leads to is cheaper
// than the one under way: no proposal makes things worse. A robot without a way waits.
//
// Several robots: one is on duty, goes, pays and catches; the others are parked and pay nothing. Duty passes
// when another robot's catch is cheaper than what is left of the present one. With the whole future known
// it does not pass: the team's cost is then the least that any of its robots can do alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/pursuit/plan.hpp"

namespace outrider {

/// Seconds that a planning call costs: truncated to whole ones, at least 1. A call that is not over in
/// 10^9 s, or took no number of seconds, costs 10^9.
int seconds_charged(double planning_s);

struct PursuitMission {
  std::vector<Cell> robots;              ///< where each is now
  std::vector<std::vector<Cell>> paths;  ///< of each, at second 0, 1, ..., time_s
  std::size_t duty = 0;                  ///< the robot that goes and pays
  std::vector<std::size_t> duties;       ///< who paid for second 1, 2, ..., time_s
  int time_s = 0;
  std::uint64_t cost = 0;
  int moves = 0;  ///< seconds in which the robot on duty changed its cell
  bool caught = false;
  std::vector<Cell> ahead;  ///< of the robot on duty at time_s + 1, time_s + 2, ...; empty: it waits
  int handovers = 0;        ///< times that duty has passed
};

/// A robot's own way from a second on, as a planner proposes it.
struct PursuitProposal {
  std::size_t robot = 0;
  PursuitPlan plan;
  int start_s = 0;  ///< the second of plan.path[0]
};

PursuitMission begin_pursuit(std::vector<Cell> robots);

/// Caught, or the target is gone.
bool is_over(const PursuitMission& mission, const PursuitProblem& problem);

/// Where a robot will be `lead_s` seconds from now when nothing new comes.
Cell robot_at(const PursuitMission& mission, std::size_t robot, int lead_s);

/// The question whose answer can be spliced `lead_s` seconds from now: `believed` from that robot and second.
PursuitProblem question(const PursuitMission& mission, const PursuitProblem& believed, std::size_t robot,
                        int lead_s);

/// Paid from now until the catch along `ahead`, if the target moves as believed; nothing when the way
/// leads to no catch.
std::optional<std::uint64_t> cost_ahead(const PursuitMission& mission, const PursuitProblem& believed);

/// Takes the proposal up where it meets the robot's way, if that makes the catch cheaper; says whether it
/// did.
bool splice(PursuitMission& mission, const PursuitProblem& believed, const PursuitProposal& proposal);

/// One second passes, judged by where the target really is. Does nothing when the mission is over.
void pass_second(PursuitMission& mission, const PursuitProblem& truth);

/// A planning call that took so long: all its seconds but one pass, what it brought is spliced, the last
/// second passes. Says whether anything was taken up.
bool step(PursuitMission& mission, const PursuitProblem& truth, const PursuitProblem& believed,
          const std::vector<PursuitProposal>& proposals, double planning_s);

}  // namespace outrider
