// Runs every planner of the path catalogue on one generated map of 512 x 512 cells. Measures the time of a
// query (median over the queries, in ms) and expansions per second.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "outrider/core/rng.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {
namespace {

constexpr int side = 512;
constexpr std::size_t query_count = 24;

/// Returns a random map with blocks of 1 to 24 cells on about a third of its area.
std::shared_ptr<const GridMap> generated_map(GridModel model) {
  Rng rng = Rng(1).child("map");
  Grid<std::uint8_t> blocked(GridFrame{{}, 1.0, side, side});
  for (int i = 0; i < 700; ++i) {
    const int w = 1 + static_cast<int>(rng.below(24)), h = 1 + static_cast<int>(rng.below(24));
    const int x0 = static_cast<int>(rng.below(side)), y0 = static_cast<int>(rng.below(side));
    for (int y = y0; y < std::min(side, y0 + h); ++y) {
      for (int x = x0; x < std::min(side, x0 + w); ++x) blocked[{x, y}] = 1;
    }
  }
  return std::make_shared<const GridMap>(*GridMap::of(blocked, model));
}

/// Returns solvable queries that lead across at least half of the map.
std::vector<Problem> long_queries(const std::shared_ptr<const GridMap>& ground) {
  Rng rng = Rng(1).child("queries");
  const ConfiguredPlanner judge = find_path_planner("a_star")->configure();
  Workspace workspace;
  std::vector<Problem> queries;
  while (queries.size() < query_count) {
    const auto point = [&] { return Vec2{rng.uniform(0.0, side), rng.uniform(0.0, side)}; };
    const Problem problem{ground, point(), point()};
    if (distance(problem.start, problem.goal) < 0.5 * side || !judge.plan(problem, {}, workspace)) continue;
    queries.push_back(problem);
  }
  return queries;
}

void run(benchmark::State& state, const PathPlanner& row, GridModel model) {
  using Clock = std::chrono::steady_clock;
  const std::vector<Problem> queries = long_queries(generated_map(model));
  const ConfiguredPlanner planner = row.configure();
  Workspace workspace;
  std::vector<double> times_ms;
  std::uint64_t expansions = 0;
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto start = Clock::now();
    const auto plan = planner.plan(queries[next++ % queries.size()], {}, workspace);
    times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    expansions += plan->counters.expansions;
    benchmark::DoNotOptimize(plan->cost);
  }
  std::nth_element(times_ms.begin(), times_ms.begin() + static_cast<std::ptrdiff_t>(times_ms.size() / 2),
                   times_ms.end());
  state.counters["median_ms"] = times_ms[times_ms.size() / 2];
  state.counters["expansions_per_s"] =
      benchmark::Counter(static_cast<double>(expansions), benchmark::Counter::kIsRate);
}

const bool registered = [] {
  for (const PathPlanner& row : path_planners()) {
    if (row.steers) continue;  // steering_bench has them
    for (const GridModel model : row.models) {
      const std::string name = std::string(row.name) + "/" + std::string(to_string(model));
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&row, model](benchmark::State& state) { run(state, row, model); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(10 * query_count);
    }
  }
  return true;
}();

}  // namespace
}  // namespace outrider
