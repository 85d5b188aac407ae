// Catches a moving target on a generated map of 1825 x 2332 cells, four fifths of them walls, and compares
// with a plain sweep of every cell in every second: time to the first catch, time to the proof, and their
// ratio.
#include <benchmark/benchmark.h>

#include <chrono>

#include "outrider/core/rng.hpp"
#include "outrider/pursuit/anytime.hpp"
#include "outrider/pursuit/sweep.hpp"

namespace outrider {
namespace {

constexpr int width = 1825, height = 2332, seconds = 5345;
constexpr std::uint32_t wall = 100;

/// Returns halls joined by corridors; the floor of each hall has its own cost between 1 and `dearest`.
PursuitProblem generated_pursuit(std::uint32_t dearest) {
  Rng rng = Rng(1).child("pursuit");
  const auto below = [&](int count) {
    return static_cast<int>(rng.below(static_cast<std::uint64_t>(count)));
  };
  CostGrid costs(GridFrame{{}, 1.0, width, height}, wall);
  const auto fill = [&](Cell low, Cell high, std::uint32_t cost) {
    for (int y = std::max(0, low.y); y <= std::min(height - 1, high.y); ++y) {
      for (int x = std::max(0, low.x); x <= std::min(width - 1, high.x); ++x) {
        costs[{x, y}] = std::min(costs[{x, y}], cost);
      }
    }
  };
  const Cell first{100, 100}, last{width - 100, height - 100};
  Cell at = first;
  for (int hall = 0; hall <= 90; ++hall) {
    const Cell next = hall == 90 ? last : Cell{below(width), below(height)};
    fill({at.x - 40, at.y - 40}, {at.x + 40, at.y + 40}, 1 + static_cast<std::uint32_t>(rng.below(dearest)));
    fill({std::min(at.x, next.x) - 3, at.y - 3}, {std::max(at.x, next.x) + 3, at.y + 3}, dearest);
    fill({next.x - 3, std::min(at.y, next.y) - 3}, {next.x + 3, std::max(at.y, next.y) + 3}, 1 + dearest / 2);
    at = next;
  }
  PursuitProblem problem;
  problem.threshold = wall;
  problem.start = first;
  for (int s = 0; s < seconds; ++s) problem.target.push_back({last.x - (s / 40) % 40, last.y});
  problem.costs = std::make_shared<const CostGrid>(std::move(costs));
  return problem;
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void optimal(benchmark::State& state) {
  const PursuitProblem problem = generated_pursuit(static_cast<std::uint32_t>(state.range(0)));
  double first_s = 0.0, proof_s = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    const double begin = now_s();
    AnytimePursuit search(problem);
    while (!search.proven() && search.improve(Budget{})) {
      if (first_s == 0.0) first_s = now_s() - begin;
    }
    proof_s = now_s() - begin;
    if (search.best()) state.counters["cost"] = static_cast<double>(search.best()->cost);
  }
  state.counters["first_s"] = first_s;
  state.counters["proof_s"] = proof_s;
}

void plain_sweep(benchmark::State& state) {
  const PursuitProblem problem = generated_pursuit(static_cast<std::uint32_t>(state.range(0)));
  for ([[maybe_unused]] auto _ : state) {
    const auto least = sweep(problem, {});
    if (least) state.counters["cost"] = static_cast<double>(least->cost);
  }
}

BENCHMARK(optimal)->Arg(1)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(plain_sweep)->Arg(1)->Arg(20)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace outrider
