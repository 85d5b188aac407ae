// Compares one search for many goals from one start with single queries, on polygon maps and grids of
// $OUTRIDER_DATA. Prints the table of docs/benchmarks/path.md. Each time is the shortest of several rounds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/io/map/polygons.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {
namespace {

constexpr int rounds = 5;

template <class Work>
double least_us(Work work) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    least = std::min(least, time.count());
  }
  return least;
}

/// Sets a start in `problem` and returns `goals` goals that the planner reaches from it.
std::vector<Vec2> joined_places(const ConfiguredPlanner& planner, Problem& problem, const Box2& box,
                                std::size_t goals) {
  Rng rng = Rng(1).child("places");
  const auto place = [&] {
    return Vec2{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
  };
  Workspace workspace;
  std::vector<Vec2> found;
  for (int misses = 0; found.size() < goals; ++misses) {
    if (found.empty() || misses > 1000) {  // the start may be in a closed area
      problem.start = place();
      found.clear();
      misses = 0;
    }
    problem.goal = place();
    if (planner.plan(problem, {}, workspace)) found.push_back(problem.goal);
  }
  return found;
}

void compare(const std::string& map, const char* name, Problem problem, const Box2& box) {
  const ConfiguredPlanner planner = find_path_planner(name)->configure();
  ConfiguredPlanner one_by_one = planner;
  one_by_one.plan_many = nullptr;
  for (const std::size_t count : {4U, 16U, 64U}) {
    const std::vector<Vec2> goals = joined_places(planner, problem, box, count);
    Workspace workspace;
    const auto ask = [&](const ConfiguredPlanner& by) { plan_each(by, problem, goals, {}, workspace); };
    ask(planner);  // builds the index before timing
    const double many_us = least_us([&] { ask(planner); }), single_us = least_us([&] { ask(one_by_one); });
    fmt::print("| {:<14} | {:<24} | {:>5} | {:>10.0f} | {:>10.0f} | {:>5.2f} |\n", map, name, count, many_us,
               single_us, many_us / single_us);
  }
}

void run(const std::string& data) {
  fmt::print("| map | planner | goals | one search us | single queries us | ratio |\n");
  for (const int number : {3, 7}) {
    const std::string name = fmt::format("map_{}", number);
    auto map = load_polygon_map(fmt::format("{}/polygons/{}.txt", data, name));
    if (!map) continue;
    auto ground = PolygonGround::of(std::move(map->boundary), std::move(map->obstacles), 0.18);
    if (!ground) continue;
    const Box2 box = ground->bounds;
    const Problem problem{nullptr, {}, {}, std::make_shared<const PolygonGround>(std::move(*ground))};
    for (const char* planner : {"visibility_graph_reduced", "visibility_graph_implicit", "least_time"}) {
      compare(name, planner, problem, box);
    }
  }
  for (const char* name : {"dao/lak303d.map", "random/random512-10-0.map.gz"}) {
    const auto map = load_movingai_map(fmt::format("{}/grids/{}", data, name));
    if (!map) continue;
    auto ground = GridMap::of(*map, GridModel::cells);
    if (!ground) continue;
    const Problem problem{std::make_shared<const GridMap>(std::move(*ground)), {}, {}};
    compare(std::string(name).substr(std::string(name).find('/') + 1, 12), "dijkstra", problem,
            problem.grid->frame.bounds());
  }
}

}  // namespace
}  // namespace outrider

int main() {
  const char* data = std::getenv("OUTRIDER_DATA");
  outrider::run(data == nullptr ? "../shared/data" : data);
}
