// PursuitState: the positions and costs of a pursuit, and how the robots take up new plans.
//
// Accounting is that of the reference's test bench: a planning call of less than 2 s costs one second, one of
// 2 to 3 s costs two, and so on. Each second charges the cell in which the robot was before it. The catch is
// tested after each second. Second 0 does not count, and the last second that counts is that of the target's
// last cell.
//
// While the planner works, the robot follows its current path. A new plan is spliced in where the robot is or
// will be on that path, and only if its catch is cheaper than the current one: no proposal makes the result
// worse. A robot without a path waits.
//
// In a team, one robot is on duty: it moves, pays and catches. The others are parked and pay nothing. Duty
// passes to another robot if its catch is cheaper than the rest of the current one. If the whole future is
// known, duty does not pass: the cost of the team is then the least cost of any of its robots alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/pursuit/plan.hpp"

namespace outrider {

/// Returns the seconds that a planning call costs: its duration truncated to whole seconds, at least 1 and at
/// most 10^9. NaN costs 10^9.
int seconds_charged(double planning_s);

/// The state of a pursuit at one second.
struct PursuitState {
  std::vector<Cell> robots;              ///< current cell of each robot
  std::vector<std::vector<Cell>> paths;  ///< path of each robot at second 0, 1, ..., time_s
  std::size_t duty = 0;                  ///< the robot that moves and pays
  std::vector<std::size_t> duties;       ///< robot that paid for second 1, 2, ..., time_s
  int time_s = 0;                        ///< current second
  std::uint64_t cost = 0;                ///< paid until now
  int moves = 0;                         ///< seconds in which the robot on duty changed its cell
  bool caught = false;                   ///< the target is caught
  std::vector<Cell> ahead;  ///< planned path of the robot on duty at time_s + 1, ...; empty: it waits
  int handovers = 0;        ///< how often duty has passed
};

/// A path that a planner proposes for a robot.
struct PursuitProposal {
  std::size_t robot = 0;
  PursuitPlan plan;
  int start_s = 0;  ///< the second of plan.path[0]
};

/// Returns the state at second 0. The first robot is on duty.
PursuitState begin_pursuit(std::vector<Cell> robots);

/// Returns true if the target is caught or gone.
bool is_over(const PursuitState& state, const PursuitProblem& problem);

/// Returns the cell of a robot `lead_s` seconds from now if it gets no new plan.
Cell robot_at(const PursuitState& state, std::size_t robot, int lead_s);

/// Returns the problem whose plan can be spliced in `lead_s` seconds from now: `believed` with that start and
/// second.
PursuitProblem question(const PursuitState& state, const PursuitProblem& believed, std::size_t robot,
                        int lead_s);

/// Returns the cost from now until the catch along `ahead` if the target moves as believed, or nothing if the
/// path leads to no catch.
std::optional<std::uint64_t> cost_ahead(const PursuitState& state, const PursuitProblem& believed);

/// Splices the proposal into the robot's path where they meet, if that makes the catch cheaper. Returns true
/// if it did.
bool splice(PursuitState& state, const PursuitProblem& believed, const PursuitProposal& proposal);

/// Advances the state by one second to these positions of the robots and the target.
void pass_second(PursuitState& state, const CostGrid& costs, const std::vector<Cell>& robots, Cell target);

}  // namespace outrider
