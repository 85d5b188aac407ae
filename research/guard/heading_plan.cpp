#include "research/guard/heading_plan.hpp"

#include <algorithm>

#include "plan/relaxed.hpp"
#include "research/guard/heading_bound.hpp"

namespace outrider {

/// The cells that a relaxed mission on the move leaves for another one to use.
class RelaxedWindows {
 public:
  explicit RelaxedWindows(const Relaxed& relaxed, const std::stop_token& stop)
      : relaxed_(relaxed), homeward_(homeward(relaxed, stop)) {}

  /// Returns false after a stop request.
  [[nodiscard]] bool complete() const { return homeward_.chosen().size() == relaxed_.chosen().size(); }

  /// Returns for each set of chosen targets the cells where a robot on the move may have these left to hit if
  /// the mission takes at most `most_s`.
  [[nodiscard]] std::vector<GridWindow> within(double most_s) const {
    std::vector<GridWindow> windows(relaxed_.value_.size());
    for (std::size_t left = 0; left < windows.size(); ++left) windows[left] = window(left, most_s);
    return windows;
  }

 private:
  /// Returns the mission over the same targets that ends at the start: it tells how long it took to hit the
  /// others.
  static Relaxed homeward(const Relaxed& relaxed, const std::stop_token& stop) {
    Relaxed back = relaxed;
    back.chosen_.clear();
    back.value_.assign(1, Field(relaxed.frame_.size(), endless));
    back.value_[0][relaxed.home_] = 0;
    back.drive(back.value_[0]);
    Budget budget;
    budget.stop = stop;
    BudgetMeter meter(budget);
    for (const std::size_t index : relaxed.chosen()) {
      if (!back.choose(index, meter, stop)) break;
    }
    return back;
  }

  [[nodiscard]] GridWindow window(std::size_t left, double most_s) const {
    const GridFrame& frame = relaxed_.frame_;
    const Field& before = homeward_.value_[relaxed_.value_.size() - 1 - left];
    const double aside_s = static_cast<double>(relaxed_.chosen().size() + 1) * relaxed_.aside_s_;
    Cell low{frame.width, frame.height}, high{-1, -1};
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const double driven_s =
          (before[c] + relaxed_.value_[left][c]) * relaxed_.unit_s_ - relaxed_.to_home_s_ - aside_s;
      if (relaxed_.on_the_move_s(driven_s) > most_s) continue;
      const Cell cell = frame.cell(c);
      low = Cell{std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = Cell{std::max(high.x, cell.x), std::max(high.y, cell.y)};
    }
    if (low.x > high.x) return {};
    return {low, high.x - low.x + 1, high.y - low.y + 1};
  }

  const Relaxed& relaxed_;
  Relaxed homeward_;
};

double heading_mission_bound(const GuardProblem& problem, const FiringMap& firing_map,
                             const std::vector<std::size_t>& targets, GuardOptions options,
                             const Budget& budget) {
  options.shoot_on_the_move = true;
  const Relaxed relaxed = relaxed_mission(problem, firing_map, targets, options, budget);
  const double without = relaxed.bound_s();
  if (!heading_bound_possible(problem, firing_map)) return without;
  const RelaxedWindows windows(relaxed, budget.stop);
  if (!windows.complete()) return without;
  std::vector<std::size_t> chosen;
  for (const std::size_t index : relaxed.chosen()) chosen.push_back(targets[index]);
  double bound = without;
  // A limit on what is searched is raised until it is not reached.
  for (const double factor : {1.3, 1.6, 2.0}) {
    const double most_s = factor * without;
    const double found = heading_bound(problem, firing_map, chosen, {most_s, windows.within(most_s)},
                                       bound_memory_bytes(options), budget.stop);
    bound = std::max(bound, found);
    if (found < most_s) break;
  }
  return bound;
}

Outcome<GuardPlan> plan_with_heading_bound(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardOptions& options, const Budget& budget,
                                           const DraftObserver& observe) {
  auto plan = plan_guard(problem, firing_map, options, budget, observe);
  if (!plan || !plan->on_the_move) return plan;
  std::vector<std::size_t> targets = plan->targets();
  std::ranges::sort(targets);
  plan->lower_bound_s = plan->anywhere_lower_bound_s =
      heading_mission_bound(problem, firing_map, targets, options, budget);
  return plan;
}

}  // namespace outrider
