// Solves tours of generated yards: the proof for up to 12 goals, the search and the bound for more. Counters:
// cost of the tour in s, its lower bound as a fraction of the cost, and whether it was proven optimal.
#include <benchmark/benchmark.h>

#include "../tests/unit/tour/random_tour.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider {
namespace {

void tour_of_yard(benchmark::State& state) {
  const auto goals = static_cast<std::size_t>(state.range(0));
  const auto stops = static_cast<std::size_t>(state.range(1));
  const TourProblem problem = random_yard(goals, stops, static_cast<std::size_t>(state.range(2)), 1);
  Tour tour;
  for (auto _ : state) tour = *solve(problem, {}, {});
  state.counters["cost_s"] = tour.cost_s;
  state.counters["bound"] = tour.lower_bound_s / tour.cost_s;
  state.counters["proven"] = tour.proven_optimal ? 1.0 : 0.0;
}

BENCHMARK(tour_of_yard)
    ->Name("tour/yard")
    ->ArgNames({"goals", "stops", "most_served"})
    ->Args({8, 40, 6})
    ->Args({12, 60, 6})
    ->Args({12, 300, 8})
    ->Args({24, 300, 12})
    ->Args({40, 300, 6})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace outrider
