#include "explore_strategies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "explore_bound.hpp"
#include "explore_grid.hpp"
#include "explore_maps.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

constexpr double clearance_m = 0.15;  // of a start
constexpr double range_m = 3.5;

/// The runs of one strategy on one map, by their starts.
struct MapRuns {
  std::string group;
  std::vector<double> over_bound;
  std::vector<double> over_nearest;
  int complete = 0;
  double max_decision_s = 0.0;
};

struct Interval {
  double value = 0.0, low = 0.0, high = 0.0;
};

struct StrategyGroupRow {
  std::string group;
  std::string strategy;
  int maps = 0, runs = 0, complete = 0;
  Interval over_bound;    ///< median
  Interval over_nearest;  ///< geometric mean
  double max_decision_s = 0.0;
};

double median_of(const std::vector<double>& values) { return quantile(values, 0.5); }

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

/// The statistic of all values of some maps, with its interval.
Interval bootstrap(const std::vector<std::vector<double>>& by_map,
                   double (*statistic)(const std::vector<double>&)) {
  constexpr int samples = 1000;
  Rng rng(1);
  std::vector<double> all, found;
  for (const auto& values : by_map) all.insert(all.end(), values.begin(), values.end());
  for (int n = 0; n < samples; ++n) {
    std::vector<double> drawn;
    for (const auto& values : by_map) {
      for (std::size_t i = 0; i < values.size(); ++i) drawn.push_back(values[rng.below(values.size())]);
    }
    found.push_back(statistic(drawn));
  }
  return {statistic(all), quantile(found, 0.025), quantile(found, 0.975)};
}

StrategyGroupRow row_of(const std::string& group, const std::string& strategy,
                        const std::vector<MapRuns>& maps) {
  StrategyGroupRow row{group, strategy, 0, 0, 0, {}, {}, 0.0};
  std::vector<std::vector<double>> over_bound, over_nearest;
  for (const MapRuns& map : maps) {
    if (group != "all" && map.group != group) continue;
    ++row.maps;
    row.runs += static_cast<int>(map.over_bound.size());
    row.complete += map.complete;
    row.max_decision_s = std::max(row.max_decision_s, map.max_decision_s);
    over_bound.push_back(map.over_bound);
    over_nearest.push_back(map.over_nearest);
  }
  row.over_bound = bootstrap(over_bound, median_of);
  row.over_nearest = bootstrap(over_nearest, geometric_mean);
  return row;
}

nlohmann::ordered_json interval_json(const Interval& interval) {
  return {interval.value, interval.low, interval.high};
}

nlohmann::ordered_json row_json(const StrategyGroupRow& row) {
  return {{"group", row.group},
          {"strategy", row.strategy},
          {"maps", row.maps},
          {"runs", row.runs},
          {"complete", row.complete},
          {"median_time_over_bound", interval_json(row.over_bound)},
          {"mean_time_over_nearest", interval_json(row.over_nearest)},
          {"max_decision_s", row.max_decision_s}};
}

std::string table_text(const std::vector<StrategyGroupRow>& rows) {
  std::string text =
      fmt::format("  {:<10} {:<17} {:>4} {:>9} {:>22} {:>24} {:>13}\n", "group", "strategy", "maps",
                  "complete", "time/bound (95 %)", "time/nearest (95 %)", "longest think");
  for (const StrategyGroupRow& row : rows) {
    text += fmt::format(
        "  {:<10} {:<17} {:>4} {:>4}/{:<4} {:>9.2f} ({:.2f}, {:.2f}) {:>10.3f} ({:.3f}, {:.3f}) {:>10.1f} "
        "ms\n",
        row.group, row.strategy, row.maps, row.complete, row.runs, row.over_bound.value, row.over_bound.low,
        row.over_bound.high, row.over_nearest.value, row.over_nearest.low, row.over_nearest.high,
        1e3 * row.max_decision_s);
  }
  return text;
}

Outcome<std::vector<ExploreMap>> chosen_maps(const ExploreRequest& request) {
  std::vector<ExploreMap> maps = generated_explore_maps();
  if (!request.data.empty()) {
    auto published = published_explore_maps(request.data);
    if (!published) return pass_on(published);
    for (ExploreMap& map : *published) maps.push_back(std::move(map));
  }
  for (const std::string& name : request.maps) {
    if (std::ranges::none_of(maps,
                             [&](const ExploreMap& map) { return map.name == name || map.group == name; }))
      return bad_input(
          fmt::format(
              "there is no map or group '{}'; groups are office, rooms, hall, maze, cave, strewn and, "
              "with --data, published",
              name),
          "--maps");
  }
  std::erase_if(maps, [&](const ExploreMap& map) {
    return !request.maps.empty() && std::ranges::none_of(request.maps, [&](const std::string& name) {
      return map.name == name || map.group == name;
    });
  });
  return maps;
}

/// All strategies on one map, from the same starts.
Status explore_map(const ExploreMap& map, std::int64_t seeds,
                   std::map<std::string, std::vector<MapRuns>>& runs, const BenchObserver& observer) {
  for (auto& [strategy, maps] : runs) maps.push_back({map.group, {}, {}, 0, 0.0});
  for (std::int64_t seed = 1; seed <= seeds; ++seed) {
    const Vec2 start = explore_start(map.solid, clearance_m, static_cast<std::uint64_t>(seed));
    const auto bound = explore_bound(map.solid, start, range_m, burger(), {.exact_cells = true});
    if (!bound) return pass_on(bound);
    GridExploration asked{map.solid, start, range_m, burger(), {}};
    std::map<std::string, GridExplorationRun> by_strategy;
    for (const auto& [strategy, maps] : runs) {
      asked.options.strategy = strategy;
      auto run = explore_on_grid(asked, observer.processor_s);
      if (!run) return pass_on(run);
      by_strategy[strategy] = std::move(*run);
    }
    const double nearest_s = by_strategy.at("nearest").time_s;
    for (auto& [strategy, maps] : runs) {
      const GridExplorationRun& run = by_strategy.at(strategy);
      maps.back().over_bound.push_back(run.time_s / std::max(1.0, bound->least_s));
      maps.back().over_nearest.push_back(run.time_s / nearest_s);
      maps.back().complete += run.complete ? 1 : 0;
      maps.back().max_decision_s = std::max(maps.back().max_decision_s, run.max_decision_s);
    }
    if (observer.part) observer.part(static_cast<double>(seed) / static_cast<double>(seeds));
  }
  return {};
}

}  // namespace

Outcome<BenchResult> compare_strategies(const ExploreRequest& request,
                                        const std::vector<std::string>& strategies,
                                        const BenchObserver& observer) {
  auto maps = chosen_maps(request);
  if (!maps) return pass_on(maps);
  std::map<std::string, std::vector<MapRuns>> runs{{"nearest", {}}};
  for (const std::string& strategy : strategies) runs[strategy] = {};
  begin_steps(observer, maps->size());
  std::vector<std::string> groups;
  for (const ExploreMap& map : *maps) {
    next_step(observer, map.name);
    if (auto ok = explore_map(map, request.seeds, runs, observer); !ok) return pass_on(ok);
    if (std::ranges::find(groups, map.group) == groups.end()) groups.push_back(map.group);
  }
  groups.emplace_back("all");
  std::vector<StrategyGroupRow> rows;
  for (const std::string& group : groups) {
    for (const auto& [strategy, by_map] : runs) rows.push_back(row_of(group, strategy, by_map));
  }
  return result_of(rows);
}

}  // namespace outrider::bench
