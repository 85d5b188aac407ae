#include "outrider/guard/bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "outrider/world/clearance.hpp"

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::size_t most_exact = 12;

using Matrix = std::vector<std::vector<double>>;

/// Least drive times between the start (index 0) and the regions, along straight lines.
Matrix least_drives(const GuardProblem& problem, const Site& site, const std::vector<std::size_t>& asked) {
  const std::size_t n = asked.size() + 1;
  Matrix time(n, std::vector<double>(n, 0.0));
  const auto set = [&](std::size_t i, std::size_t j, double distance_m) {
    time[i][j] = time[j][i] = duration(distance_m, problem.robot.straight());
  };
  for (std::size_t i = 1; i < n; ++i) {
    const FiringRegion& region = site.regions[asked[i - 1]];
    Grid<std::uint8_t> sources(site.frame);
    double from_start = inf;
    for (std::size_t c = 0; c < site.frame.size(); ++c) {
      if (region.pitch[c] == FiringRegion::no_shot) continue;
      sources.cells[c] = 1;
      from_start =
          std::min(from_start, distance(problem.start.position, site.frame.centre(site.frame.cell(c))));
    }
    set(0, i, from_start);
    const auto squared = squared_clearance(sources);
    for (std::size_t j = i + 1; j < n; ++j) {
      double least = inf;
      for (std::size_t c = 0; c < site.frame.size(); ++c) {
        if (site.regions[asked[j - 1]].pitch[c] == FiringRegion::no_shot) continue;
        least = std::min(least, static_cast<double>(squared.cells[c]));
      }
      set(i, j, std::sqrt(least) * site.frame.resolution_m);
    }
  }
  return time;
}

/// Regions that lie far apart, the farthest first: the start, then always the region whose nearest chosen
/// one is farthest away.
std::vector<std::size_t> spread_out(const Matrix& cost, std::size_t most) {
  std::vector<std::size_t> chosen{0};
  std::vector<double> nearest(cost[0]);
  while (chosen.size() < std::min(most, cost.size())) {
    const auto far = std::max_element(nearest.begin(), nearest.end());
    if (*far <= 0.0) break;
    const auto next = static_cast<std::size_t>(far - nearest.begin());
    chosen.push_back(next);
    for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = std::min(nearest[i], cost[next][i]);
  }
  return chosen;
}

Matrix part_of(const Matrix& cost, const std::vector<std::size_t>& nodes) {
  Matrix part;
  for (const std::size_t i : nodes) {
    part.emplace_back();
    for (const std::size_t j : nodes) part.back().push_back(cost[i][j]);
  }
  return part;
}

/// Shortest path from node 0 through all others, by subsets (Held and Karp 1962).
double shortest_path_through_all(const Matrix& cost) {
  const std::size_t n = cost.size() - 1;
  if (n == 0) return 0.0;
  const std::size_t subsets = std::size_t{1} << n;
  std::vector<double> best(subsets * n, inf);
  for (std::size_t i = 0; i < n; ++i) best[(std::size_t{1} << i) * n + i] = cost[0][i + 1];
  for (std::size_t set = 1; set < subsets; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      const double so_far = best[set * n + last];
      if (so_far == inf) continue;
      for (std::size_t next = 0; next < n; ++next) {
        const std::size_t with = set | std::size_t{1} << next;
        if (with == set) continue;
        best[with * n + next] = std::min(best[with * n + next], so_far + cost[last + 1][next + 1]);
      }
    }
  }
  return *std::min_element(best.end() - static_cast<std::ptrdiff_t>(n), best.end());
}

/// Least time of flight over the cells of a region: the ball crosses the gap at full speed.
double least_flight(const GuardProblem& problem, const Site& site, std::size_t t) {
  const Target& target = problem.targets[t];
  double nearest = inf;
  for (std::size_t c = 0; c < site.frame.size(); ++c) {
    if (site.regions[t].pitch[c] == FiringRegion::no_shot) continue;
    nearest = std::min(nearest, distance(xy(target.base), site.frame.centre(site.frame.cell(c))));
  }
  const double tip = std::hypot(problem.gun.tip_forward_m, problem.gun.tip_up_m);
  const double gap =
      nearest - tip - 0.5 * std::hypot(target.size.x, target.size.y) - problem.gun.ball_radius_m;
  return std::max(0.0, gap) / problem.gun.muzzle_speed_mps;
}

}  // namespace

double mission_bound(const GuardProblem& problem, const Site& site) {
  std::vector<std::size_t> asked;
  for (std::size_t t = 0; t < site.regions.size(); ++t) {
    if (site.regions[t].hits > 0) asked.push_back(t);
  }
  if (asked.empty()) return 0.0;
  const Matrix drives = least_drives(problem, site, asked);
  std::vector<std::size_t> chosen = spread_out(drives, most_exact + 1);
  double bound = 0.0;
  for (; chosen.size() > 1; chosen.pop_back()) {
    bound = std::max(bound, shortest_path_through_all(part_of(drives, chosen)));
  }
  for (const std::size_t t : asked) bound += least_flight(problem, site, t);
  return bound;
}

}  // namespace outrider
