#include "outrider/jobs/guard/plan/bound.hpp"

#include <algorithm>
#include <limits>

#include "plan/relaxed.hpp"

namespace outrider {
double mission_bound(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const GuardOptions& options,
                     const Budget& budget) {
  return relaxed_mission(problem, firing_map, targets, options, budget).bound_s();
}

double team_bound(const GuardProblem& problem, const FiringMap& firing_map,
                  const std::vector<std::size_t>& targets, const std::vector<Pose2>& starts,
                  const GuardOptions& options, const Budget& budget) {
  const Relaxed relaxed = relaxed_mission(problem, firing_map, targets, options, budget);
  const std::size_t sets = std::size_t{1} << relaxed.chosen().size();
  std::vector<double> least(sets, std::numeric_limits<double>::infinity());  // of the robots so far, by set
  least[0] = 0.0;
  for (const Pose2& start : starts) {
    const std::vector<double> alone = relaxed.values_from(start.position);
    std::vector<double> next = least;
    for (std::size_t set = 1; set < sets; ++set) {
      for (std::size_t own = set; own != 0; own = (own - 1) & set)
        next[set] = std::min(next[set], std::max(least[set & ~own], alone[own]));
    }
    least = std::move(next);
  }
  return least.back();
}

}  // namespace outrider
