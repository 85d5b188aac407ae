#include "outrider/jobs/pursue/state.hpp"

#include <algorithm>

namespace outrider {

int seconds_charged(double planning_s) {
  constexpr double most_s = 1e9;
  if (!(planning_s < most_s)) return static_cast<int>(most_s);
  return std::max(1, static_cast<int>(planning_s));
}

PursuitState begin_pursuit(std::vector<Cell> robots) {
  PursuitState state;
  state.robots = std::move(robots);
  for (const Cell cell : state.robots) state.paths.push_back({cell});
  return state;
}

bool is_over(const PursuitState& state, const PursuitProblem& problem) {
  return state.caught || state.time_s >= problem.last_s();
}

Cell robot_at(const PursuitState& state, std::size_t robot, int lead_s) {
  if (robot != state.duty || lead_s <= 0 || state.ahead.empty()) return state.robots[robot];
  return state.ahead[std::min(static_cast<std::size_t>(lead_s), state.ahead.size()) - 1];
}

PursuitProblem question(const PursuitState& state, const PursuitProblem& believed, std::size_t robot,
                        int lead_s) {
  PursuitProblem asked = believed;
  asked.start = robot_at(state, robot, lead_s);
  asked.start_s = state.time_s + lead_s;
  return asked;
}

std::optional<std::uint64_t> cost_ahead(const PursuitState& state, const PursuitProblem& believed) {
  std::uint64_t cost = 0;
  Cell at = state.robots[state.duty];
  auto second = static_cast<std::size_t>(state.time_s);
  for (const Cell next : state.ahead) {
    if (++second >= believed.target.size()) return std::nullopt;
    cost += (*believed.costs)[at];
    at = next;
    if (at == believed.target[second]) return cost;
  }
  return std::nullopt;
}

bool splice(PursuitState& state, const PursuitProblem& believed, const PursuitProposal& proposal) {
  const std::vector<Cell>& path = proposal.plan.path;
  PursuitState other;
  other.robots = state.robots;
  other.time_s = state.time_s;
  other.duty = proposal.robot;
  if (proposal.start_s <= state.time_s) {  // it should have begun: only where the robot has kept to it
    const auto late = static_cast<std::size_t>(state.time_s - proposal.start_s);
    if (late >= path.size() || path[late] != state.robots[proposal.robot]) return false;
    other.ahead.assign(path.begin() + static_cast<std::ptrdiff_t>(late) + 1, path.end());
  } else {
    const int lead_s = proposal.start_s - state.time_s;
    if (path.empty() || path.front() != robot_at(state, proposal.robot, lead_s)) return false;
    if (proposal.robot == state.duty) other.ahead = state.ahead;
    other.ahead.resize(static_cast<std::size_t>(lead_s), path.front());
    other.ahead.insert(other.ahead.end(), path.begin() + 1, path.end());
  }
  const auto present = cost_ahead(state, believed), proposed = cost_ahead(other, believed);
  if (!proposed || (present && *present <= *proposed)) return false;
  state.duty = other.duty;
  state.ahead = std::move(other.ahead);
  return true;
}

void pass_second(PursuitState& state, const CostGrid& costs, const std::vector<Cell>& robots, Cell target) {
  const Cell before = state.robots[state.duty];
  state.robots = robots;
  const Cell robot = robots[state.duty];
  state.cost += costs[before];
  if (robot != before) ++state.moves;
  if (!state.ahead.empty()) state.ahead.erase(state.ahead.begin());
  ++state.time_s;
  if (!state.duties.empty() && state.duties.back() != state.duty) ++state.handovers;
  state.duties.push_back(state.duty);
  for (std::size_t i = 0; i < robots.size(); ++i) state.paths[i].push_back(robots[i]);
  state.caught = robot == target;
}

}  // namespace outrider
