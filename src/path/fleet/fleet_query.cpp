#include "fleet_query.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/path/problem.hpp"

namespace outrider::fleet {
namespace {

Status check_sizes(const FleetProblem& problem) {
  if (!problem.grid) return bad_input("the problem has no grid; a fleet needs one as its ground");
  if (problem.grid->model != GridModel::cells) {
    return bad_input("fleets take grids of the model 'cells', not 'corners'", "model");
  }
  const std::size_t robots = problem.starts.size();
  if (problem.goals.size() != robots) {
    return bad_input(fmt::format("{} starts came with {} goals; give one goal for each robot", robots,
                                 problem.goals.size()));
  }
  if (robots == 0 || robots > most_fleet_robots) {
    return bad_input(
        fmt::format("a fleet of {} robots is not valid; expected 1 to {}", robots, most_fleet_robots));
  }
  const std::size_t most = most_fleet_distances / problem.grid->marks.size();
  if (robots > most) {
    return bad_input(fmt::format("{} robots on this grid need too much memory; it allows {}", robots, most));
  }
  return {};
}

/// Returns the least steps from each cell. A stop leaves cells out.
std::vector<std::uint32_t> steps_to(const Query& query, State goal, const std::stop_token& stop) {
  std::vector<std::uint32_t> steps(query.ground.marks.size(), unreachable);
  std::vector<State> reached{goal};
  steps[goal] = 0;
  for (std::size_t i = 0; i < reached.size() && !stop.stop_requested(); ++i) {
    query.for_each_step(reached[i], [&](State next) {
      if (steps[next] != unreachable) return;
      steps[next] = steps[reached[i]] + 1;
      reached.push_back(next);
    });
  }
  return steps;
}

/// Refuses two robots with the same state.
Status check_distinct(const std::vector<State>& states, const GridMap& ground, std::string_view what) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto same = std::find(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(i), states[i]);
    if (*same != states[i] || same == states.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    const Cell c = ground.at(states[i]);
    return bad_input(fmt::format("the robots {} and {} have the same {}, cell ({}, {}); give each its own",
                                 same - states.begin() + 1, i + 1, what, c.x, c.y));
  }
  return {};
}

}  // namespace

Outcome<Query> query_of(const FleetProblem& problem, const Budget& budget) {
  if (auto ok = check_sizes(problem); !ok) return pass_on(ok);
  Query query{*problem.grid, {}, {}, {}};
  for (std::size_t i = 0; i < problem.starts.size(); ++i) {
    auto ends = grid_query({problem.grid, problem.starts[i], problem.goals[i]});
    if (!ends) {
      ends.error().where = fmt::format("robot {}", i + 1);
      return pass_on(ends);
    }
    query.starts.push_back(query.ground.index(ends->start));
    query.goals.push_back(query.ground.index(ends->goal));
  }
  if (auto ok = check_distinct(query.starts, query.ground, "start"); !ok) return pass_on(ok);
  if (auto ok = check_distinct(query.goals, query.ground, "goal"); !ok) return pass_on(ok);
  for (std::size_t i = 0; i < query.robots(); ++i) {
    query.steps.push_back(steps_to(query, query.goals[i], budget.stop));
    if (budget.stop.stop_requested()) return BudgetMeter(budget).refusal();
    if (query.steps[i][query.starts[i]] != unreachable) continue;
    return fault(FaultCode::no_path, fmt::format("nothing joins the start and the goal of robot {}", i + 1));
  }
  return query;
}

FleetPlan plan_of(const Query& query, const std::vector<Track>& tracks, std::uint64_t expansions) {
  FleetPlan plan;
  plan.expansions = expansions;
  std::size_t longest = 0;
  for (const Track& track : tracks) longest = std::max(longest, track.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    std::vector<Cell> path;
    for (const State s : tracks[i]) path.push_back(query.ground.at(s));
    path.resize(longest, path.back());
    plan.cost += arrival_step(path);
    plan.lower_bound += query.steps[i][query.starts[i]];
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

}  // namespace outrider::fleet
