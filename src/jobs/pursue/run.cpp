#include "outrider/jobs/pursue/run.hpp"

#include <algorithm>
#include <cstdlib>

#include "outrider/sim/simulated_team.hpp"

namespace outrider {
namespace {

Outcome<PursuitRun> run(const PursuitProblem& truth, const PursuitRules& rules, Robot& robot,
                        StopWatch& watch, const std::function<void(const PursuitRun&)>& look) {
  PursuitMission mission(truth, truth.target.size(), rules, watch, look);
  run_mission(mission, robot, rules.budget.stop, [&](const Observation&, const Command*) {
    if (look) look(mission.run);
  });
  if (mission.fault) return tl::unexpected<Fault>(std::move(*mission.fault));
  return std::move(mission.run);
}

}  // namespace

Outcome<PursuitRun> pursue(const PursuitProblem& truth, const std::vector<Cell>& robots,
                           const PursuitRules& rules, StopWatch& watch,
                           const std::function<void(const PursuitRun&)>& look, const TeamFaults& faults,
                           std::uint64_t seed) {
  for (const Cell robot : robots) {
    PursuitProblem problem = truth;
    problem.start = robot;
    if (auto ok = check(problem); !ok) return pass_on(ok);
  }
  if (!faults.any()) {
    SimulatedTeam team(robots, truth.target, rules.known_s);
    return run(truth, rules, team, watch, look);
  }
  const auto free = [&](Cell cell) { return truth.costs->contains(cell) && !truth.wall(cell); };
  SimulatedTeam team(robots, truth.target, rules.known_s, faults, free, Rng(seed));
  auto done = run(truth, rules, team, watch, look);
  if (done) done->faults = team.counts();
  return done;
}

Outcome<PursuitRun> pursue(const PursuitProblem& truth, const PursuitRules& rules, NavigatedPursuer& robot,
                           StopWatch& watch, const std::function<void(const PursuitRun&)>& look) {
  if (auto ok = check(truth); !ok) return pass_on(ok);
  return run(truth, rules, robot, watch, look);
}

std::vector<Cell> place_team(const PursuitProblem& problem, std::size_t count) {
  const CostGrid& costs = *problem.costs;
  std::vector<Cell> team{problem.start};
  std::vector<int> nearest(costs.cells.size(), std::numeric_limits<int>::max());
  while (team.size() < count) {
    std::size_t best = costs.frame.index(team.back());
    nearest[best] = 0;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const Cell cell = costs.frame.cell(i);
      const int away = std::max(std::abs(cell.x - team.back().x), std::abs(cell.y - team.back().y));
      nearest[i] = std::min(nearest[i], away);
      if (costs.cells[i] < problem.threshold && nearest[i] > nearest[best]) best = i;
    }
    team.push_back(costs.frame.cell(best));
  }
  return team;
}

}  // namespace outrider
