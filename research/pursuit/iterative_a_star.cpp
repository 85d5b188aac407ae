#include "research/pursuit/iterative_a_star.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

namespace outrider {
namespace {

constexpr std::uint64_t unpaid = std::numeric_limits<std::uint64_t>::max();

/// A* over cells; consecutive searches use the same memory.
class SpaceSearch {
 public:
  SpaceSearch(const PursuitProblem& problem, BudgetMeter& meter)
      : problem_(problem),
        meter_(meter),
        paid_(problem.costs->cells.size(), unpaid),
        from_(problem.costs->cells.size()) {
    least_ = problem.threshold;
    for (const std::uint32_t cost : problem.costs->cells) least_ = std::min(least_, cost);
  }

  /// Returns the cells from the start to the goal that minimise cost + penalty x steps; an empty list if
  /// there is no path; nothing if the budget ends.
  std::optional<std::vector<Cell>> way(Cell goal, std::uint64_t penalty) {
    for (const std::size_t i : touched_) paid_[i] = unpaid;
    touched_.clear();
    const GridFrame& frame = problem_.costs->frame;
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
    const auto add = [&](Cell cell, std::uint64_t paid, std::size_t from) {
      const std::size_t i = frame.index(cell);
      if (paid >= paid_[i]) return;
      if (paid_[i] == unpaid) touched_.push_back(i);
      paid_[i] = paid;
      from_[i] = static_cast<std::uint32_t>(from);
      open.emplace(paid + (least_ + penalty) * moves(cell, goal), paid, i);
    };
    add(problem_.start, 0, frame.index(problem_.start));
    while (!open.empty()) {
      const auto [bound, paid, i] = open.top();
      open.pop();
      if (paid != paid_[i]) continue;
      if (!meter_.spend()) return std::nullopt;
      const Cell cell = frame.cell(i);
      if (cell == goal) return back_from(i);
      const std::uint64_t after = paid + problem_.costs->cells[i] + penalty;
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Cell next{cell.x + x, cell.y + y};
          if (problem_.costs->contains(next) && !problem_.wall(next)) add(next, after, i);
        }
      }
    }
    return std::vector<Cell>{};
  }

 private:
  using QueueEntry = std::tuple<std::uint64_t, std::uint64_t, std::size_t>;  // bound, paid, cell

  static std::uint64_t moves(Cell a, Cell b) {
    return static_cast<std::uint64_t>(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)));
  }

  [[nodiscard]] std::vector<Cell> back_from(std::size_t i) const {
    std::vector<Cell> cells{problem_.costs->frame.cell(i)};
    for (; from_[i] != i; i = from_[i]) cells.push_back(problem_.costs->frame.cell(from_[i]));
    std::ranges::reverse(cells);
    return cells;
  }

  const PursuitProblem& problem_;
  BudgetMeter& meter_;
  std::uint32_t least_ = 0;  ///< cost of any cell
  std::vector<std::uint64_t> paid_;
  std::vector<std::uint32_t> from_;
  std::vector<std::size_t> touched_;
};

/// Returns the plan along the cells, one per second, until the robot first meets the target.
PursuitPlan plan_until_catch(const PursuitProblem& problem, const std::vector<Cell>& way) {
  PursuitPlan plan;
  plan.path.push_back(way.front());
  plan.catch_time_s = problem.start_s;
  plan.earliest_catch_s = -1;
  for (std::size_t s = 1; s < way.size(); ++s) {
    plan.cost += (*problem.costs)[way[s - 1]];
    plan.path.push_back(way[s]);
    ++plan.catch_time_s;
    if (way[s] == problem.target[static_cast<std::size_t>(plan.catch_time_s)]) break;
  }
  return plan;
}

}  // namespace

std::vector<Option> describe(IterativeAStarOptions& options) {
  return {{"goals", "", 1, 1e6, "seconds of the trajectory that are tried, from the last one back",
           &options.goals}};
}

Outcome<PursuitPlan> iterative_a_star(const PursuitProblem& problem, const IterativeAStarOptions& options,
                                      const Budget& budget, Workspace&) {
  if (auto ok = check(problem); !ok) return pass_on(ok);
  constexpr std::uint64_t most_penalty = 1'000'000'000;
  BudgetMeter meter(budget);
  SpaceSearch search(problem, meter);
  std::optional<PursuitPlan> best;
  const int seconds = problem.last_s() - problem.start_s;
  const int goals = static_cast<int>(std::min<std::int64_t>(options.goals, seconds));
  for (int g = 0; g < goals; ++g) {
    const int after = seconds - static_cast<int>(static_cast<std::int64_t>(g) * seconds / goals);
    const Cell goal = problem.target[static_cast<std::size_t>(problem.start_s + after)];
    if (problem.wall(goal)) continue;
    for (std::uint64_t penalty = 0; penalty <= most_penalty; penalty = penalty == 0 ? 1 : 10 * penalty) {
      auto way = search.way(goal, penalty);
      if (!way && !best) return meter.refusal();
      if (!way || way->empty()) break;
      if (way->size() > static_cast<std::size_t>(after) + 1) continue;  // late
      way->resize(static_cast<std::size_t>(after) + 1, goal);
      PursuitPlan plan = plan_until_catch(problem, *way);
      if (!best || plan.cost < best->cost) best = std::move(plan);
      break;
    }
  }
  if (!best) {
    return fault(FaultCode::budget_exhausted,
                 "none of the goals that were tried could be reached in time; that proves nothing, ask for "
                 "more goals or the planner optimal");
  }
  best->counters.expansions = meter.spent();
  return *best;
}

}  // namespace outrider
