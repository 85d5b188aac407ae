// PursuitState: where a pursuit stands, what it has cost, and how what a planner brings is taken up.
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

struct PursuitState {
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

PursuitState begin_pursuit(std::vector<Cell> robots);

/// Caught, or the target is gone.
bool is_over(const PursuitState& state, const PursuitProblem& problem);

/// Where a robot will be `lead_s` seconds from now when nothing new comes.
Cell robot_at(const PursuitState& state, std::size_t robot, int lead_s);

/// The question whose answer can be spliced `lead_s` seconds from now: `believed` from that robot and second.
PursuitProblem question(const PursuitState& state, const PursuitProblem& believed, std::size_t robot,
                        int lead_s);

/// Paid from now until the catch along `ahead`, if the target moves as believed; nothing when the way
/// leads to no catch.
std::optional<std::uint64_t> cost_ahead(const PursuitState& state, const PursuitProblem& believed);

/// Takes the proposal up where it meets the robot's way, if that makes the catch cheaper; says whether it
/// did.
bool splice(PursuitState& state, const PursuitProblem& believed, const PursuitProposal& proposal);

/// The second after time_s has passed: the robots are there now, and the target is.
void pass_second(PursuitState& state, const CostGrid& costs, const std::vector<Cell>& robots, Cell target);

}  // namespace outrider
