// Measures cheapest paths on ground with costs: the index of terrain_labels against terrain_a_star. Prints
// the table of docs/planners/terrain_labels.md.
//
// Each ground has 40 disks of costs from 1 to 10 strewn over it, of which the later ones cover the earlier.
// The queries are 200 random pairs of cells that a path joins, each at its shortest of three rounds. Reads
// maps of MovingAI from $OUTRIDER_DATA/grids, beside open squares.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/path/grid/terrain/terrain_a_star.hpp"
#include "outrider/path/hubs/terrain_labels.hpp"

namespace outrider {
namespace {

constexpr int queries = 200, rounds = 3;

std::shared_ptr<const CellCosts> strewn_costs(const GridFrame& frame) {
  Rng rng = Rng(7).child("costs");
  Grid<float> costs(frame, 1.0F);
  for (int disk = 0; disk < 40; ++disk) {
    const auto cost = static_cast<float>(rng.uniform(1.0, 10.0));
    const Vec2 centre{rng.uniform(0, frame.width), rng.uniform(0, frame.height)};
    const double radius = rng.uniform(2.0, 0.15 * frame.width);
    for (std::size_t i = 0; i < costs.cells.size(); ++i) {
      const Cell c = frame.cell(i);
      if (distance(centre, Vec2{c.x + 0.5, c.y + 0.5}) < radius) costs.cells[i] = cost;
    }
  }
  return std::make_shared<const CellCosts>(CellCosts::of(std::move(costs)).value());
}

template <class Ask>
double shortest_us(const Ask& ask) {
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    ask();
    best = std::min(
        best, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

void measure(const std::string& name, const Grid<std::uint8_t>& blocked, std::int64_t mib) {
  const auto ground = std::make_shared<const GridMap>(GridMap::of(blocked, GridModel::cells).value());
  Problem problem{ground, {}, {}};
  problem.costs = strewn_costs(blocked.frame);
  const auto free = std::count(blocked.cells.begin(), blocked.cells.end(), 0);
  problem.start = problem.goal = ground->point(blocked.frame.cell(static_cast<std::size_t>(
      std::find(blocked.cells.begin(), blocked.cells.end(), 0) - blocked.cells.begin())));
  Workspace workspace;
  const TerrainLabelsOptions options{mib};
  const auto begin = std::chrono::steady_clock::now();
  const auto first = terrain_labels(problem, options, {}, workspace);
  const double made_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print("| {} | {} | {} | {:.2f} |", name, free, mib, made_s);
  if (!first || !first->remark.empty()) {
    fmt::print(" does not fit | | |\n");
    return;
  }
  Rng rng = Rng(8).child("queries");
  double labels_us = 0.0, search_us = 0.0, worst = 0.0;
  for (int done = 0; done < queries;) {
    problem.start = {rng.uniform(0, blocked.frame.width), rng.uniform(0, blocked.frame.height)};
    problem.goal = {rng.uniform(0, blocked.frame.width), rng.uniform(0, blocked.frame.height)};
    const auto found = terrain_labels(problem, options, {}, workspace);
    if (!found) continue;
    const auto truth = terrain_a_star(problem, {}, {}, workspace);
    worst = std::max(worst, std::abs(found->cost - truth->cost) / std::max(1.0, truth->cost));
    labels_us += shortest_us([&] { (void)terrain_labels(problem, options, {}, workspace); });
    search_us += shortest_us([&] { (void)terrain_a_star(problem, {}, {}, workspace); });
    ++done;
  }
  fmt::print(" {:.1f} | {:.0f} | {:.0e} |\n", labels_us / queries, search_us / queries, worst);
}

}  // namespace
}  // namespace outrider

int main() {
  using namespace outrider;
  fmt::print(
      "| ground | free cells | `hub_memory` | made in s | `terrain_labels` us | `terrain_a_star` us | "
      "largest difference |\n|:--|--:|--:|--:|--:|--:|--:|\n");
  const char* const data = std::getenv("OUTRIDER_DATA");
  for (const char* const name : {"den312d", "lak303d", "brc202d"}) {
    if (data == nullptr) break;
    for (const char* const ending : {".map", ".map.gz"}) {
      const auto map = load_movingai_map(fmt::format("{}/grids/dao/{}{}", data, name, ending));
      if (map) measure(name, *map, 64);
    }
  }
  for (const int side : {100, 200, 300}) {
    measure(fmt::format("open {0} x {0}", side), Grid<std::uint8_t>(GridFrame{{}, 1.0, side, side}), 64);
  }
  measure("open 200 x 200", Grid<std::uint8_t>(GridFrame{{}, 1.0, 200, 200}), 256);
}
