// Prints the time of one query of jps on open ground, ns: the best of some rounds of many queries. The same
// ground and queries are those of python_calls.py, which compares.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "outrider/path/catalog.hpp"

int main() {
  using namespace outrider;
  constexpr int side = 16, queries = 20'000, rounds = 15;
  Grid<std::uint8_t> grid;
  grid.frame = {{}, 1.0, side, side};
  grid.cells.assign(grid.frame.size(), 0);
  const ConfiguredPlanner planner = find_path_planner("jps").value().configure();
  Workspace workspace;
  Problem problem{
      std::make_shared<const GridMap>(GridMap::of(grid, GridModel::cells).value()), {0.5, 0.5}, {3.5, 0.5}};
  double best = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < queries; ++i) sum += planner.plan(problem, {}, workspace).value().cost;
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    best = std::min(best, spent.count() / queries);
  }
  if (sum != 3.0 * queries * rounds) return 1;
  fmt::print("{:.1f}\n", best);
}
