#include "research/guard/heading_bound.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "outrider/core/parallel.hpp"

namespace outrider {
namespace {

constexpr double most_work = 2e8;   // values of all sets together
constexpr double most_cells = 8e5;  // of a yard
constexpr int finest = 4;

/// How finely cells are divided: so that a robot at full speed crosses one in a 16th of the time that a halt
/// costs.
int fineness(const Limits& straight, double resolution_m) {
  const double cell_m = straight.speed * straight.speed / straight.acceleration / 16.0;
  return static_cast<int>(
      std::ceil(std::clamp(resolution_m / cell_m - 1e-9, 1.0, static_cast<double>(finest))));
}

}  // namespace

bool heading_bound_possible(const GuardProblem& problem, const FiringMap& firing_map) {
  const int fine = fineness(problem.robot.straight(), firing_map.frame.resolution_m);
  return static_cast<double>(firing_map.frame.size()) * fine * fine <= most_cells;
}

double heading_bound(const GuardProblem& problem, const FiringMap& firing_map,
                     const std::vector<std::size_t>& targets, const HeadingLimits& limits,
                     double memory_bytes, const std::stop_token& stop) {
  const Limits straight = problem.robot.straight();
  const HeadingFields fields(problem, firing_map, fineness(straight, firing_map.frame.resolution_m));
  std::vector<GridWindow> windows;
  double work = 0.0;
  for (const GridWindow& cells : limits.cells) {
    windows.push_back(fields.around(cells));
    work += fields.size(windows.back());
  }
  if (!fields.useful() || work > std::min(most_work, memory_bytes / sizeof(Units))) return 0.0;
  std::vector<std::vector<Units>> masks;
  masks.reserve(targets.size());
  for (const std::size_t target : targets) masks.push_back(fields.mask(firing_map.regions[target]));
  std::vector<HeadingValues> values(windows.size());
  values[0] = fields.constant(windows[0], 0);
  for (std::size_t left = 1; left <= targets.size(); ++left) {
    std::vector<std::size_t> sets;
    for (std::size_t set = 1; set < values.size(); ++set) {
      if (static_cast<std::size_t>(std::popcount(set)) == left && !windows[set].empty()) sets.push_back(set);
    }
    const bool done = parallel_for(sets.size(), stop, [&](std::size_t i) {
      HeadingValues& here = values[sets[i]] = fields.constant(windows[sets[i]], never_units);
      for (std::size_t bit = 0; bit < targets.size(); ++bit) {
        const std::size_t after = sets[i] & ~(std::size_t{1} << bit);
        if (after != sets[i] && !windows[after].empty()) fields.hit(masks[bit], values[after], here);
      }
      fields.settle(here);
    });
    if (!done) return 0.0;
  }
  const double last_halt_s = 0.5 * straight.speed / straight.acceleration;  // that drive need not end
  const Units least = windows.back().empty() ? never_units : fields.at_start(values.back());
  return std::clamp(least * fields.unit_s() - last_halt_s, 0.0, limits.most_s);
}

}  // namespace outrider
