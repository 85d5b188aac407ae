#include "research/guard/bounded_tour.hpp"

#include <algorithm>

#include "plan/relaxed.hpp"
#include "research/guard/heading_bound.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_chosen = 8;

/// Returns for each set of chosen targets the cells where a robot may have these left to hit if the mission
/// takes at most `most_s`; `homeward` tells how long it took to hit the others.
std::vector<GridWindow> windows(const GridFrame& frame, const Relaxed& onward, const Relaxed& homeward,
                                double most_s) {
  const int chosen = static_cast<int>(onward.chosen().size());
  std::vector<GridWindow> windows(std::size_t{1} << chosen);
  for (std::size_t left = 0; left < windows.size(); ++left) {
    const Field& before = homeward.value(windows.size() - 1 - left);
    const Field& after = onward.value(left);
    Cell low{frame.width, frame.height}, high{-1, -1};
    for (std::size_t c = 0; c < frame.size(); ++c) {
      if (onward.mission_s(before[c] + after[c], chosen + 1) > most_s) continue;
      const Cell cell = frame.cell(c);
      low = Cell{std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = Cell{std::max(high.x, cell.x), std::max(high.y, cell.y)};
    }
    if (low.x <= high.x) windows[left] = {low, high.x - low.x + 1, high.y - low.y + 1};
  }
  return windows;
}

}  // namespace

double bound_with_headings(const GuardProblem& problem, const FiringMap& firing_map,
                           const std::vector<std::size_t>& targets, const GuardOptions& options,
                           const Budget& budget) {
  const Relaxed onward = relaxed_over_hardest(problem, firing_map, targets, options, most_chosen, budget);
  const double without = onward.bound_s();
  if (!heading_bound_possible(problem, firing_map)) return without;
  Relaxed homeward(problem, firing_map, targets, true, true);
  Budget stoppable;
  stoppable.stop = budget.stop;
  BudgetMeter meter(stoppable);
  std::vector<std::size_t> chosen;
  for (const std::size_t index : onward.chosen()) {
    if (!homeward.choose(index, meter, budget.stop)) return without;
    chosen.push_back(targets[index]);
  }
  double bound = without;
  // A limit on what is searched for it is raised until it is not reached.
  for (const double factor : {1.3, 1.6, 2.0}) {
    const double most_s = factor * without;
    const HeadingLimits limits{most_s, windows(firing_map.frame, onward, homeward, most_s)};
    const double found =
        heading_bound(problem, firing_map, chosen, limits, bound_memory_bytes(options), budget.stop);
    bound = std::max(bound, found);
    if (found < most_s) break;
  }
  return bound;
}

Outcome<GuardPlan> bounded_tour(const GuardProblem& problem, const FiringMap& firing_map,
                                const GuardOptions& options, const Budget& budget,
                                const DraftObserver& observe) {
  auto plan = plan_guard(problem, firing_map, options, budget, observe);
  if (!plan || !options.shoot_on_the_move || options.prove) return plan;  // a proof is of a plan from rest
  std::vector<std::size_t> targets;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (std::ranges::count(plan->unreachable, t, &Unreachable::target) == 0) targets.push_back(t);
  }
  if (targets.empty()) return plan;
  plan->lower_bound_s = plan->anywhere_lower_bound_s =
      bound_with_headings(problem, firing_map, targets, options, budget);
  return plan;
}

}  // namespace outrider
