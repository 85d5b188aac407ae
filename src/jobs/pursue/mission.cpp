#include "outrider/jobs/pursue/mission.hpp"

#include <algorithm>

namespace outrider {

int seconds_charged(double planning_s) {
  constexpr double most_s = 1e9;
  if (!(planning_s < most_s)) return static_cast<int>(most_s);
  return std::max(1, static_cast<int>(planning_s));
}

PursuitMission begin_pursuit(std::vector<Cell> robots) {
  PursuitMission mission;
  mission.robots = std::move(robots);
  for (const Cell cell : mission.robots) mission.paths.push_back({cell});
  return mission;
}

bool is_over(const PursuitMission& mission, const PursuitProblem& problem) {
  return mission.caught || mission.time_s >= problem.last_s();
}

Cell robot_at(const PursuitMission& mission, std::size_t robot, int lead_s) {
  if (robot != mission.duty || lead_s <= 0 || mission.ahead.empty()) return mission.robots[robot];
  return mission.ahead[std::min(static_cast<std::size_t>(lead_s), mission.ahead.size()) - 1];
}

PursuitProblem question(const PursuitMission& mission, const PursuitProblem& believed, std::size_t robot,
                        int lead_s) {
  PursuitProblem asked = believed;
  asked.start = robot_at(mission, robot, lead_s);
  asked.start_s = mission.time_s + lead_s;
  return asked;
}

std::optional<std::uint64_t> cost_ahead(const PursuitMission& mission, const PursuitProblem& believed) {
  std::uint64_t cost = 0;
  Cell at = mission.robots[mission.duty];
  auto second = static_cast<std::size_t>(mission.time_s);
  for (const Cell next : mission.ahead) {
    if (++second >= believed.target.size()) return std::nullopt;
    cost += (*believed.costs)[at];
    at = next;
    if (at == believed.target[second]) return cost;
  }
  return std::nullopt;
}

bool splice(PursuitMission& mission, const PursuitProblem& believed, const PursuitProposal& proposal) {
  const std::vector<Cell>& path = proposal.plan.path;
  PursuitMission other;
  other.robots = mission.robots;
  other.time_s = mission.time_s;
  other.duty = proposal.robot;
  if (proposal.start_s <= mission.time_s) {  // it should have begun: only where the robot has kept to it
    const auto late = static_cast<std::size_t>(mission.time_s - proposal.start_s);
    if (late >= path.size() || path[late] != mission.robots[proposal.robot]) return false;
    other.ahead.assign(path.begin() + static_cast<std::ptrdiff_t>(late) + 1, path.end());
  } else {
    const int lead_s = proposal.start_s - mission.time_s;
    if (path.empty() || path.front() != robot_at(mission, proposal.robot, lead_s)) return false;
    if (proposal.robot == mission.duty) other.ahead = mission.ahead;
    other.ahead.resize(static_cast<std::size_t>(lead_s), path.front());
    other.ahead.insert(other.ahead.end(), path.begin() + 1, path.end());
  }
  const auto present = cost_ahead(mission, believed), proposed = cost_ahead(other, believed);
  if (!proposed || (present && *present <= *proposed)) return false;
  mission.duty = other.duty;
  mission.ahead = std::move(other.ahead);
  return true;
}

void pass_second(PursuitMission& mission, const PursuitProblem& truth) {
  if (is_over(mission, truth)) return;
  Cell& robot = mission.robots[mission.duty];
  mission.cost += (*truth.costs)[robot];
  if (!mission.ahead.empty()) {
    if (mission.ahead.front() != robot) ++mission.moves;
    robot = mission.ahead.front();
    mission.ahead.erase(mission.ahead.begin());
  }
  ++mission.time_s;
  if (!mission.duties.empty() && mission.duties.back() != mission.duty) ++mission.handovers;
  mission.duties.push_back(mission.duty);
  for (std::size_t i = 0; i < mission.robots.size(); ++i) {
    mission.paths[i].push_back(mission.robots[i]);
  }
  mission.caught = robot == truth.target[static_cast<std::size_t>(mission.time_s)];
}

bool step(PursuitMission& mission, const PursuitProblem& truth, const PursuitProblem& believed,
          const std::vector<PursuitProposal>& proposals, double planning_s) {
  const int seconds = seconds_charged(planning_s);
  for (int s = 1; s < seconds && !is_over(mission, truth); ++s) pass_second(mission, truth);
  bool taken = false;
  for (const PursuitProposal& proposal : proposals) taken = splice(mission, believed, proposal) || taken;
  pass_second(mission, truth);
  return taken;
}

}  // namespace outrider
