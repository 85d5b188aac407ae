// Builds the firing map of a yard with the firing regions of all its targets, on one thread; the counter
// shows the number of places with a shot. The yard is the bundled one, or that of the scenario named by
// OUTRIDER_GUARD_SCENARIO.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <string>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {
namespace {

void survey_of_yard(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const char* named = std::getenv("OUTRIDER_GUARD_SCENARIO");
  const std::string path = named == nullptr ? OUTRIDER_SCENARIOS "/yard/yard.yaml" : named;
  GuardJob job;
  if (auto ok = read_scenario(job, path); !ok) return state.SkipWithError(ok.error().sentence.c_str());
  if (auto ok = job.load(); !ok) return state.SkipWithError(ok.error().sentence.c_str());
  GuardScenario& scenario = job.scenario;
  scenario.options.resolution_m = static_cast<double>(state.range(0)) / 1000.0;
  std::size_t hits = 0;
  for (auto _ : state) {
    const auto firing_map = build_firing_map(scenario.problem, scenario.options);
    if (!firing_map) return state.SkipWithError(firing_map.error().sentence.c_str());
    hits = 0;
    for (const FiringRegion& region : firing_map->regions) hits += region.hits;
  }
  state.counters["hits"] = static_cast<double>(hits);
}

BENCHMARK(survey_of_yard)
    ->Name("survey/yard")
    ->ArgName("mm")
    ->Arg(100)
    ->Arg(40)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace outrider
