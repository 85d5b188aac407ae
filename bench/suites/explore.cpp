// Measures every exploration strategy in every world, over many seeds.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "explore_bound.hpp"
#include "explore_strategies.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/explore/choose/catalog.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

struct BenchWorld {
  std::string name;
  ExploreSetup setup;
  double least_s = 0.0;  ///< lower bound of the time of a run (explore_bound.hpp)
};

/// Holds the results of one strategy in one world; each vector has one value per seed.
struct StrategyRow {
  std::string world;
  std::string strategy;
  double least_s = 0.0;
  int runs = 0;
  int done = 0;
  std::vector<double> explored, time_s, distance_m, decisions, max_decision_s, map_error_m, contacts;
};

/// Returns the cells of 5 cm whose centres are inside a solid at the height of the laser.
Grid<std::uint8_t> solid_cells(const ExploreSetup& setup) {
  const auto pieces = cut_at(setup.world, setup.sim.laser.height_m);
  Box2 box;
  box.include(setup.task.start.position);
  for (const RoundedPolygon& piece : pieces) {
    box.include(piece.bounds().low);
    box.include(piece.bounds().high);
  }
  Grid<std::uint8_t> solid(covering(box.grown(0.1), 0.05));
  for (const RoundedPolygon& piece : pieces) {
    const Cell low = solid.frame.cell_at(piece.bounds().low), high = solid.frame.cell_at(piece.bounds().high);
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        if (signed_distance(solid.frame.centre({x, y}), piece) <= 0.0) solid[{x, y}] = 1;
      }
    }
  }
  return solid;
}

Outcome<BenchWorld> loaded(const std::string& name, const ExploreScenario& scenario) {
  auto setup = load_explore(scenario);
  if (!setup) return pass_on(setup);
  const auto bound = explore_bound(solid_cells(*setup), setup->task.start.position, setup->sim.laser.most_m,
                                   setup->task.robot, {.return_home = setup->task.rules.return_home});
  if (!bound) return pass_on(bound);
  return BenchWorld{name, std::move(*setup), bound->least_s};
}

/// Loads the named scenarios, then the worlds of the reference report from the data folder.
Outcome<std::vector<BenchWorld>> load_worlds(const ExploreRequest& request) {
  std::vector<BenchWorld> worlds;
  for (const std::string& path : request.scenarios) {
    ExploreJob job;
    if (auto ok = read_scenario(job, path); !ok) return pass_on(ok);
    auto world = loaded(std::filesystem::path(path).stem().string(), job.scenario);
    if (!world) return pass_on(world);
    worlds.push_back(std::move(*world));
  }
  if (request.data.empty()) return worlds;
  for (const auto& [name, start] : {std::pair{"closed_maze", "-1,0,0"}, {"house_closed", "-3,1,0"}}) {
    ExploreScenario scenario;
    scenario.world.world = fmt::format("{}/{}.world", request.data, name);
    scenario.start = start;
    auto world = loaded(name, scenario);
    if (!world) return pass_on(world);
    worlds.push_back(std::move(*world));
  }
  return worlds;
}

Outcome<std::vector<std::string>> chosen_strategies(const ExploreRequest& request) {
  std::vector<std::string> names = request.strategies;
  if (names.empty()) {
    for (const ExploreStrategy& row : explore_strategies()) names.emplace_back(row.name);
  }
  for (const std::string& name : names) {
    if (auto row = find_explore_strategy(name); !row) return bad_input(row.error().sentence, "--strategies");
  }
  return names;
}

Outcome<StrategyRow> measured(const BenchWorld& world, const std::string& strategy, std::int64_t seeds,
                              const BenchObserver& observer) {
  StrategyRow row{world.name, strategy, world.least_s, 0, 0, {}, {}, {}, {}, {}, {}, {}};
  ExploreTask task = world.setup.task;
  task.explore.strategy = strategy;
  for (std::int64_t seed = 1; seed <= seeds; ++seed) {
    Log log;
    const auto run =
        run_explore(world.setup.world, task, world.setup.sim, static_cast<std::uint64_t>(seed), log);
    if (!run) return pass_on(run);
    ++row.runs;
    row.done += run->report.status == "done" ? 1 : 0;
    const auto keep = [&](std::vector<double>& values, std::string_view name) {
      values.push_back(metric(run->report, name));
    };
    keep(row.explored, "explored_fraction");
    keep(row.time_s, "time_s");
    keep(row.distance_m, "distance_m");
    keep(row.decisions, "decisions");
    keep(row.max_decision_s, "max_decision_s");
    keep(row.map_error_m, "map_error_m");
    keep(row.contacts, "contacts");
    if (observer.part) observer.part(static_cast<double>(seed) / static_cast<double>(seeds));
  }
  return row;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
double least(const std::vector<double>& values) { return *std::ranges::min_element(values); }
double most(const std::vector<double>& values) { return *std::ranges::max_element(values); }

nlohmann::ordered_json row_json(const StrategyRow& row) {
  return {{"world", row.world},
          {"strategy", row.strategy},
          {"runs", row.runs},
          {"done", row.done},
          {"median_explored_fraction", median(row.explored)},
          {"least_explored_fraction", least(row.explored)},
          {"median_time_s", median(row.time_s)},
          {"least_time_s", least(row.time_s)},
          {"lower_bound_s", row.least_s},
          {"most_time_s", most(row.time_s)},
          {"median_distance_m", median(row.distance_m)},
          {"median_decisions", median(row.decisions)},
          {"max_decision_s", most(row.max_decision_s)},
          {"median_map_error_m", median(row.map_error_m)},
          {"most_map_error_m", most(row.map_error_m)},
          {"most_contacts", most(row.contacts)}};
}

std::string table_text(const std::vector<StrategyRow>& rows) {
  std::string text = fmt::format("  {:<14} {:<18} {:>5} {:>18} {:>20} {:>8} {:>9} {:>9} {:>15} {:>9} {:>8}\n",
                                 "world", "strategy", "done", "explored % (least)", "time s (median, most)",
                                 "bound s", "driven m", "decisions", "longest think", "error mm", "contacts");
  for (const StrategyRow& row : rows) {
    text += fmt::format(
        "  {:<14} {:<18} {:>2}/{:<2} {:>9.2f} {:>8.2f} {:>12.1f} {:>8.1f} {:>8.1f} {:>9.1f} {:>9.0f} "
        "{:>12.1f} ms "
        "{:>9.1f} "
        "{:>8.0f}\n",
        row.world, row.strategy, row.done, row.runs, 100.0 * median(row.explored),
        100.0 * least(row.explored), median(row.time_s), most(row.time_s), row.least_s,
        median(row.distance_m), median(row.decisions), 1e3 * most(row.max_decision_s),
        1e3 * most(row.map_error_m), most(row.contacts));
  }
  return text;
}

}  // namespace

Outcome<BenchResult> measure_explore(const ExploreRequest& request, const BenchObserver& observer) {
  auto strategies = chosen_strategies(request);
  if (!strategies) return pass_on(strategies);
  if (request.grids) return compare_strategies(request, *strategies, observer);
  auto worlds = load_worlds(request);
  if (!worlds) return pass_on(worlds);
  begin_steps(observer, worlds->size() * strategies->size());
  std::vector<StrategyRow> rows;
  for (const BenchWorld& world : *worlds) {
    for (const std::string& strategy : *strategies) {
      next_step(observer, fmt::format("{} in {}", strategy, world.name));
      auto row = measured(world, strategy, request.seeds, observer);
      if (!row) return pass_on(row);
      rows.push_back(std::move(*row));
    }
  }
  return result_of(rows);
}

}  // namespace outrider::bench
