#include "outrider/jobs/guard/plan/bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "heading_bound.hpp"
#include "relaxed.hpp"

namespace outrider {
namespace {

constexpr std::size_t usual_chosen = 8;
constexpr std::size_t most_chosen = 13;

/// The bound on the move with turns and halts. A limit on what is searched for it is raised until it is not
/// reached.
double with_headings(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const Relaxed& relaxed, double memory_bytes,
                     const std::stop_token& stop) {
  std::vector<std::size_t> chosen;
  for (const std::size_t index : relaxed.chosen()) chosen.push_back(targets[index]);
  const double without = relaxed.bound_s();
  double bound = without;
  const Relaxed homeward = relaxed.homeward(stop);
  if (homeward.chosen().size() < chosen.size()) return bound;
  for (const double factor : {1.3, 1.6, 2.0}) {
    const double most_s = factor * without;
    const double found = heading_bound(problem, firing_map, chosen,
                                       {most_s, relaxed.windows(homeward, most_s)}, memory_bytes, stop);
    bound = std::max(bound, found);
    if (found < most_s) break;
  }
  return bound;
}

/// Memory that the fields of a bound may take: half of what there is where a proof is asked for.
double memory_limit_bytes(const GuardOptions& options) {
  return (options.prove ? 0.5 : 0.25) * static_cast<double>(options.memory_mib) * 1048576.0;
}

/// The relaxed mission over at most so many targets, each time the hardest, and fewer if memory or budget
/// end.
Relaxed with_hardest(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const GuardOptions& options, std::size_t most,
                     const Budget& budget) {
  const double field = sizeof(std::uint16_t) * static_cast<double>(firing_map.frame.size());
  BudgetMeter meter(budget);
  Relaxed relaxed(problem, firing_map, targets, options.shoot_on_the_move);
  while (relaxed.chosen().size() < most &&
         std::ldexp(field, static_cast<int>(relaxed.chosen().size()) + 1) <= memory_limit_bytes(options)) {
    const auto next = relaxed.hardest();
    if (!next || !relaxed.choose(*next, meter, budget.stop)) break;
  }
  return relaxed;
}

}  // namespace

double mission_bound(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const GuardOptions& options,
                     const Budget& budget) {
  const std::size_t most = options.prove ? most_chosen : usual_chosen;
  const Relaxed relaxed = with_hardest(problem, firing_map, targets, options, most, budget);
  if (!options.shoot_on_the_move || !heading_bound_possible(problem, firing_map)) return relaxed.bound_s();
  return with_headings(problem, firing_map, targets, relaxed, memory_limit_bytes(options), budget.stop);
}

double team_bound(const GuardProblem& problem, const FiringMap& firing_map,
                  const std::vector<std::size_t>& targets, const std::vector<Pose2>& starts,
                  const GuardOptions& options, const Budget& budget) {
  const Relaxed relaxed = with_hardest(problem, firing_map, targets, options, usual_chosen, budget);
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
