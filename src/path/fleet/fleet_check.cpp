#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "outrider/path/fleet/fleet.hpp"

namespace outrider {
namespace {

tl::unexpected<Fault> refused(std::string sentence) { return bad_input(std::move(sentence), "plan"); }

Status check_path(const std::vector<Cell>& path, const FleetProblem& problem, std::size_t robot) {
  const GridMap& ground = *problem.grid;
  if (!(ground.vertex_at(problem.starts[robot]) == path.front()))
    return refused(fmt::format("robot {} does not begin at its start", robot + 1));
  if (!(ground.vertex_at(problem.goals[robot]) == path.back()))
    return refused(fmt::format("robot {} does not end at its goal", robot + 1));
  for (std::size_t t = 0; t < path.size(); ++t) {
    if (ground.blocked(path[t]))
      return refused(fmt::format("robot {} is in a blocked cell at step {}", robot + 1, t));
    if (t == 0) continue;
    const int moved = std::abs(path[t].x - path[t - 1].x) + std::abs(path[t].y - path[t - 1].y);
    if (moved > 1) return refused(fmt::format("robot {} moves by {} cells in step {}", robot + 1, moved, t));
  }
  return {};
}

Status check_pair(const std::vector<std::vector<Cell>>& paths, std::size_t a, std::size_t b) {
  for (std::size_t t = 0; t < paths[a].size(); ++t) {
    if (paths[a][t] == paths[b][t])
      return refused(fmt::format("robots {} and {} are in one cell at step {}", a + 1, b + 1, t));
    if (t > 0 && paths[a][t] == paths[b][t - 1] && paths[b][t] == paths[a][t - 1])
      return refused(fmt::format("robots {} and {} exchange their cells in step {}", a + 1, b + 1, t));
  }
  return {};
}

}  // namespace

std::uint64_t arrival_step(const std::vector<Cell>& path) {
  std::size_t step = path.size();
  while (step > 1 && path[step - 2] == path.back()) --step;
  return step == 0 ? 0 : step - 1;
}

Status check(const FleetPlan& plan, const FleetProblem& problem) {
  const auto& paths = plan.paths;
  if (!problem.grid) return bad_input("the problem has no grid to check the plan on");
  if (paths.size() != problem.starts.size() || paths.size() != problem.goals.size() || paths.empty())
    return refused(fmt::format("{} paths came for {} robots", paths.size(), problem.starts.size()));
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty() || paths[i].size() != paths.front().size())
      return refused(fmt::format("the path of robot {} is not as long as the others", i + 1));
    if (auto ok = check_path(paths[i], problem, i); !ok) return ok;
    for (std::size_t j = 0; j < i; ++j) {
      if (auto ok = check_pair(paths, j, i); !ok) return ok;
    }
    std::size_t last_away = 0;  // steps after which it has not yet stayed
    for (std::size_t t = 0; t < paths[i].size(); ++t) {
      if (!(paths[i][t] == paths[i].back())) last_away = t + 1;
    }
    sum += last_away;
  }
  if (plan.cost != sum)
    return refused(fmt::format("the cost is {}, but its robots add up to {}", plan.cost, sum));
  if (plan.lower_bound > plan.cost)
    return refused(fmt::format("the lower bound {} is above the cost {}", plan.lower_bound, plan.cost));
  return {};
}

}  // namespace outrider
