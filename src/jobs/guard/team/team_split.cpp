#include "team/team_split.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "outrider/core/parallel.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider {
namespace {

constexpr double unknown_s = std::numeric_limits<double>::infinity();
constexpr std::size_t most_runs = 12;  // between the places that are tried as cuts
constexpr int most_moves_of_targets = 24;
constexpr std::int64_t estimate_iterations = 100;

/// The stops, shots and drives for one part: the start of the robot, and the stops with shots at its targets.
TourProblem part_table(const TourProblem& table, SplitStart start, const std::vector<std::size_t>& targets) {
  TourProblem part{targets.size(),
                   start.heading_rad,
                   table.turning,
                   table.yaw_rate_radps,
                   table.pitch_rate_radps,
                   {{}},
                   {}};
  std::vector<std::size_t> stops{start.stop};
  auto services = services_of(table, targets);
  for (std::size_t stop = 0; stop < services.size(); ++stop) {
    if (services[stop].empty()) continue;
    stops.push_back(stop);
    part.services.push_back(std::move(services[stop]));
  }
  for (const std::size_t from : stops) {
    for (const std::size_t to : stops) part.drives.push_back(table.drives[from * table.services.size() + to]);
  }
  return part;
}

std::vector<std::size_t> sorted(std::vector<std::size_t> targets) {
  std::ranges::sort(targets);
  return targets;
}

/// Returns a copy without one target.
std::vector<std::size_t> without(const std::vector<std::size_t>& targets, std::size_t target) {
  std::vector<std::size_t> rest = targets;
  std::erase(rest, target);
  return rest;
}

}  // namespace

double SplitSearch::compute_s(const Part& part) const {
  std::vector<std::size_t> targets;
  for (const std::size_t t : part.second) {
    if (stops_.reachable[t] != 0) targets.push_back(t);
  }
  if (targets.empty()) return 0.0;
  TourOptions options;
  options.exact_goals = 0;
  options.iterations = estimate_iterations;
  options.gap = 1.0;
  const auto tour = solve(part_table(stops_.table, starts_[part.first], targets), options, budget_);
  return tour ? tour->cost_s : unknown_s;
}

void SplitSearch::estimate_all(std::vector<Part> parts) {
  for (Part& part : parts) part.second = sorted(std::move(part.second));
  std::ranges::sort(parts);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  std::erase_if(parts, [&](const Part& part) { return estimates_.contains(part); });
  std::vector<double> found(parts.size(), unknown_s);
  parallel_for(parts.size(), [&](std::size_t i) { found[i] = compute_s(parts[i]); });
  for (std::size_t i = 0; i < parts.size(); ++i) estimates_.emplace(std::move(parts[i]), found[i]);
}

double SplitSearch::estimate_s(std::size_t robot, const std::vector<std::size_t>& targets) {
  Part part{robot, sorted(targets)};
  if (const auto known = estimates_.find(part); known != estimates_.end()) return known->second;
  const double time_s = compute_s(part);
  estimates_.emplace(std::move(part), time_s);
  return time_s;
}

std::vector<std::size_t> SplitSearch::by_way(std::vector<std::size_t> targets) const {
  std::vector<double> least_s(stops_.table.goals, unknown_s);
  for (std::size_t stop = 0; stop < stops_.table.services.size(); ++stop) {
    const double way_s = stops_.table.drives[stop].time_s;  // from the first start
    for (const Service& service : stops_.table.services[stop])
      least_s[service.goal] = std::min(least_s[service.goal], way_s);
  }
  std::ranges::stable_sort(targets, {}, [&](std::size_t t) { return least_s[t]; });
  return targets;
}

double SplitSearch::makespan_s(const TargetSplit& split) {
  double latest_s = 0.0;
  for (std::size_t r = 0; r < split.size(); ++r) latest_s = std::max(latest_s, scaled_s(r, split[r]));
  return latest_s;
}

TargetSplit SplitSearch::cut(const std::vector<std::size_t>& order) {
  const std::size_t runs = std::min(most_runs, order.size());
  const auto place = [&](std::size_t i) {
    return order.begin() + static_cast<std::ptrdiff_t>(i * order.size() / std::max<std::size_t>(1, runs));
  };
  const auto run = [&](std::size_t i, std::size_t j) { return std::vector<std::size_t>(place(i), place(j)); };
  std::vector<Part> parts;
  for (std::size_t r = 0; r < starts_.size(); ++r) {
    for (std::size_t i = 0; i < runs; ++i) {
      for (std::size_t j = i + 1; j <= runs; ++j) parts.emplace_back(r, run(i, j));
    }
  }
  estimate_all(std::move(parts));
  // For each order of the robots along the list, the least makespan of the first few robots up to each place.
  std::vector<std::size_t> robots(starts_.size());
  std::iota(robots.begin(), robots.end(), std::size_t{0});
  TargetSplit best(starts_.size());
  best.front() = order;
  double best_s = unknown_s;
  do {
    std::vector<double> least(runs + 1, unknown_s);
    least[0] = 0.0;
    std::vector<std::vector<std::size_t>> from;  // by number of robots and place
    for (const std::size_t robot : robots) {
      std::vector<double> next(runs + 1, unknown_s);
      auto& origin = from.emplace_back(runs + 1, 0);
      for (std::size_t j = 0; j <= runs; ++j) {
        for (std::size_t i = 0; i <= j; ++i) {
          const double time_s = std::max(least[i], i < j ? scaled_s(robot, run(i, j)) : 0.0);
          if (time_s < next[j]) next[j] = time_s, origin[j] = i;
        }
      }
      least = std::move(next);
    }
    if (least[runs] >= best_s) continue;
    best_s = least[runs];
    for (std::size_t k = robots.size(), j = runs; k-- > 0; j = from[k][j])
      best[robots[k]] = run(from[k][j], j);
  } while (std::next_permutation(robots.begin(), robots.end()));
  return best;
}

std::vector<TargetSplit> SplitSearch::neighbours(const TargetSplit& split, std::size_t latest) {
  std::vector<TargetSplit> all;
  for (std::size_t r = 0; r < split.size(); ++r) {
    if (r == latest) continue;
    for (const std::size_t given : split[latest]) {
      TargetSplit moved = split;
      moved[latest] = without(split[latest], given);
      moved[r].push_back(given);
      for (const std::size_t taken : split[r]) {
        TargetSplit exchanged = moved;
        exchanged[latest].push_back(taken);
        exchanged[r] = without(moved[r], taken);
        all.push_back(std::move(exchanged));
      }
      all.push_back(std::move(moved));
    }
  }
  return all;
}

bool SplitSearch::improve_once(TargetSplit& split) {
  std::size_t latest = 0;
  for (std::size_t r = 1; r < split.size(); ++r) {
    if (scaled_s(r, split[r]) > scaled_s(latest, split[latest])) latest = r;
  }
  std::vector<TargetSplit> all = neighbours(split, latest);
  std::vector<Part> parts;
  for (const TargetSplit& other : all) {
    for (std::size_t r = 0; r < other.size(); ++r) parts.emplace_back(r, other[r]);
  }
  estimate_all(std::move(parts));
  double best_s = makespan_s(split) - 1e-6;
  TargetSplit* best = nullptr;
  for (TargetSplit& other : all) {
    const double time_s = makespan_s(other);
    if (time_s >= best_s) continue;
    best_s = time_s;
    best = &other;
  }
  if (best == nullptr) return false;
  split = std::move(*best);
  return true;
}

TargetSplit SplitSearch::improve(TargetSplit split) {
  for (int moves = 0; moves < most_moves_of_targets && improve_once(split); ++moves) {
  }
  return split;
}

}  // namespace outrider
