#include "research/pursuit/real_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

namespace outrider {
namespace {

class Follower {
 public:
  Follower(const PursuitProblem& problem, std::int64_t lookahead, BudgetMeter& meter)
      : problem_(problem), lookahead_(lookahead), meter_(meter), surplus_(problem.costs->cells.size(), 0) {
    for (const std::uint32_t cost : problem.costs->cells) least_ = std::min(least_, cost);
  }

  /// Returns the next cell from here towards the goal; nothing if the budget ends.
  std::optional<Cell> move(Cell here, Cell goal) {
    const GridFrame& frame = problem_.costs->frame;
    std::map<std::size_t, Seen> seen{{frame.index(here), {}}};
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
    open.emplace(estimate(here, goal), 0, frame.index(here));
    std::vector<std::size_t> searched;
    std::size_t aim = frame.index(here);
    std::uint64_t bound = 0;
    while (!open.empty()) {
      std::uint64_t paid = 0;
      std::tie(bound, paid, aim) = open.top();
      const Cell cell = frame.cell(aim);
      Seen& state = seen[aim];
      if (state.closed || paid != state.paid) {
        open.pop();
        continue;
      }
      const bool arrived = cell == goal && aim != frame.index(here);
      if (arrived || static_cast<std::int64_t>(searched.size()) == lookahead_) break;
      if (!meter_.spend()) return std::nullopt;
      open.pop();
      state.closed = true;
      searched.push_back(aim);
      expand(cell, goal, paid + problem_.costs->cells[aim], seen, open);
    }
    for (const std::size_t i : searched) learn(i, bound - std::min(bound, seen[i].paid), goal);
    if (aim == frame.index(here)) return here;
    while (seen[aim].from != frame.index(here)) aim = seen[aim].from;
    return frame.cell(aim);
  }

 private:
  using QueueEntry = std::tuple<std::uint64_t, std::uint64_t, std::size_t>;  // bound, paid, cell
  struct Seen {
    std::uint64_t paid = 0;
    std::size_t from = 0;
    bool closed = false;
  };

  void expand(Cell cell, Cell goal, std::uint64_t after, std::map<std::size_t, Seen>& seen,
              std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>>& open) {
    const GridFrame& frame = problem_.costs->frame;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Cell next{cell.x + x, cell.y + y};
        if (next == cell || !problem_.costs->contains(next) || problem_.wall(next)) continue;
        const auto [found, fresh] = seen.try_emplace(frame.index(next));
        if (!fresh && found->second.paid <= after) continue;
        found->second = {after, frame.index(cell), false};
        open.emplace(after + estimate(next, goal), after, found->first);
      }
    }
  }

  /// Returns the cost of the straight path to the goal if every cell had the least cost of the map.
  [[nodiscard]] std::uint64_t straight(Cell cell, Cell goal) const {
    const auto moves = std::max(std::abs(cell.x - goal.x), std::abs(cell.y - goal.y));
    return std::uint64_t{std::max(1U, least_)} * static_cast<std::uint64_t>(moves);
  }
  [[nodiscard]] std::uint64_t estimate(Cell cell, Cell goal) const {
    return straight(cell, goal) + surplus_[problem_.costs->frame.index(cell)];
  }
  void learn(std::size_t i, std::uint64_t value, Cell goal) {
    const std::uint64_t base = straight(problem_.costs->frame.cell(i), goal);
    if (value > base) surplus_[i] = std::max(surplus_[i], value - base);
  }

  const PursuitProblem& problem_;
  std::int64_t lookahead_;
  BudgetMeter& meter_;
  std::uint32_t least_ = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint64_t> surplus_;  ///< learned, over the straight distance
};

Outcome<PursuitPlan> follow(const PursuitProblem& problem, std::int64_t lookahead, const Budget& budget) {
  if (auto ok = check(problem); !ok) return pass_on(ok);
  BudgetMeter meter(budget);
  Follower follower(problem, lookahead, meter);
  PursuitPlan plan;
  plan.path = {problem.start};
  plan.earliest_catch_s = -1;
  int nearest = std::numeric_limits<int>::max();
  for (int s = problem.start_s; s < problem.last_s(); ++s) {
    const Cell here = plan.path.back();
    const auto next = follower.move(here, problem.target[static_cast<std::size_t>(s)]);
    if (!next) return meter.refusal();
    plan.cost += (*problem.costs)[here];
    plan.path.push_back(*next);
    const Cell target = problem.target[static_cast<std::size_t>(s) + 1];
    nearest = std::min(nearest, std::max(std::abs(target.x - next->x), std::abs(target.y - next->y)));
    if (target != *next) continue;
    plan.catch_time_s = s + 1;
    plan.counters.expansions = meter.spent();
    return plan;
  }
  return fault(FaultCode::budget_exhausted,
               fmt::format("it followed the target until that was gone, {} cells behind at the nearest; the "
                           "planner optimal looks ahead",
                           nearest));
}

}  // namespace

std::vector<Option> describe(LrtaStarOptions&) { return {}; }

std::vector<Option> describe(RtaaStarOptions& options) {
  return {{"lookahead", "", 1, 1e6, "cells searched each second", &options.lookahead}};
}

Outcome<PursuitPlan> lrta_star(const PursuitProblem& problem, const LrtaStarOptions&, const Budget& budget,
                               Workspace&) {
  return follow(problem, 1, budget);
}

Outcome<PursuitPlan> rtaa_star(const PursuitProblem& problem, const RtaaStarOptions& options,
                               const Budget& budget, Workspace&) {
  return follow(problem, options.lookahead, budget);
}

}  // namespace outrider
