#include "research/pursuit/multi_goal_a_star.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace outrider {
namespace {

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

template <class Visit>
void for_each_step(const PursuitProblem& problem, Cell cell, Visit visit) {
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const Cell next{cell.x + x, cell.y + y};
      if (problem.costs->contains(next) && !problem.wall(next)) visit(next);
    }
  }
}

/// Returns the least cost from every cell to any cell of the target in any second (backward Dijkstra). A stop
/// leaves cells out.
std::vector<std::uint64_t> costs_to_go(const PursuitProblem& problem, const std::stop_token& stop) {
  const CostGrid& costs = *problem.costs;
  std::vector<std::uint64_t> to_go(costs.cells.size(), never);
  using QueueEntry = std::pair<std::uint64_t, std::size_t>;
  std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
  for (auto t = static_cast<std::size_t>(problem.start_s) + 1; t < problem.target.size(); ++t) {
    const std::size_t i = costs.frame.index(problem.target[t]);
    if (problem.wall(problem.target[t]) || to_go[i] == 0) continue;
    to_go[i] = 0;
    open.emplace(0, i);
  }
  while (!open.empty() && !stop.stop_requested()) {
    const auto [cost, i] = open.top();
    open.pop();
    if (cost != to_go[i]) continue;
    for_each_step(problem, costs.frame.cell(i), [&, to = cost](Cell before) {
      const std::size_t j = costs.frame.index(before);
      if (to + costs.cells[j] >= to_go[j]) return;
      to_go[j] = to + costs.cells[j];
      open.emplace(to_go[j], j);
    });
  }
  return to_go;
}

struct State {
  std::uint64_t paid = 0;
  std::uint32_t cell = 0;
  std::int32_t second = 0;
  std::uint32_t from = 0;  ///< index of the state before
};

/// The set of expanded (cell, second) states; uses memory only for cells that were reached.
class Closed {
 public:
  Closed(std::size_t cells, std::size_t seconds) : seconds_(seconds), bits_(cells) {}

  /// Closes a state; returns true the first time.
  bool close(std::size_t cell, int second) {
    auto& bits = bits_[cell];
    if (bits.empty()) bits.resize(seconds_);
    const bool first = !bits[static_cast<std::size_t>(second)];
    bits[static_cast<std::size_t>(second)] = true;
    return first;
  }

 private:
  std::size_t seconds_;
  std::vector<std::vector<bool>> bits_;
};

PursuitPlan plan_to(const PursuitProblem& problem, const std::vector<State>& states, std::size_t last) {
  PursuitPlan plan;
  plan.cost = plan.lower_bound = states[last].paid;
  plan.catch_time_s = states[last].second;
  plan.earliest_catch_s = -1;
  for (std::size_t i = last;; i = states[i].from) {
    plan.path.push_back(problem.costs->frame.cell(states[i].cell));
    if (states[i].from == i) break;
  }
  std::ranges::reverse(plan.path);
  return plan;
}

}  // namespace

std::vector<Option> describe(MultiGoalAStarOptions& options) {
  return {{"states", "", 1, 4e9, "states in memory at most", &options.states}};
}

Outcome<PursuitPlan> multi_goal_a_star(const PursuitProblem& problem, const MultiGoalAStarOptions& options,
                                       const Budget& budget, Workspace&) {
  if (auto ok = check(problem); !ok) return pass_on(ok);
  const CostGrid& costs = *problem.costs;
  const auto to_go = costs_to_go(problem, budget.stop);
  const auto start = static_cast<std::uint32_t>(costs.frame.index(problem.start));
  Closed closed(costs.cells.size(), problem.target.size());
  std::vector<State> states{{0, start, problem.start_s, 0}};
  using QueueEntry =
      std::tuple<std::uint64_t, std::int32_t, std::uint32_t>;  // bound, last seconds first, state
  std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
  if (to_go[start] != never) open.emplace(to_go[start], -problem.start_s, 0);
  BudgetMeter meter(budget);
  if (budget.stop.stop_requested()) return meter.refusal();
  while (!open.empty()) {
    const std::uint32_t at = std::get<2>(open.top());
    open.pop();
    const State state = states[at];
    if (!closed.close(state.cell, state.second)) continue;
    if (!meter.spend()) return meter.refusal();
    const Cell cell = costs.frame.cell(state.cell);
    if (state.second > problem.start_s && cell == problem.target[static_cast<std::size_t>(state.second)]) {
      PursuitPlan plan = plan_to(problem, states, at);
      plan.counters = {meter.spent(), states.size()};
      return plan;
    }
    if (state.second >= problem.last_s()) continue;
    if (states.size() + 9 > static_cast<std::size_t>(options.states)) {
      return fault(
          FaultCode::budget_exhausted,
          fmt::format("more than {} states; allow more, or take the planner optimal", options.states));
    }
    for_each_step(problem, cell, [&](Cell next) {
      const auto i = static_cast<std::uint32_t>(costs.frame.index(next));
      if (to_go[i] == never) return;
      const std::uint64_t paid = state.paid + costs.cells[state.cell];
      open.emplace(paid + to_go[i], -(state.second + 1), static_cast<std::uint32_t>(states.size()));
      states.push_back({paid, i, state.second + 1, at});
    });
  }
  return fault(FaultCode::no_path, "no cell of the target can be reached in the second in which it is there");
}

}  // namespace outrider
