// Measures when a visibility graph pays off, on the polygon maps of $OUTRIDER_DATA/polygons and the outlines
// of the grid den312d: the cost of building each graph, the cost of a query on each graph, without a graph
// and on a navigation mesh, and the number of queries after which a graph has paid for itself. Prints the
// table of docs/benchmarks/path.md. Each time is the shortest of several rounds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>

#include "outrider/core/rng.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/io/map/polygons.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"

namespace outrider {
namespace {

constexpr int rounds = 15;

struct World {
  std::string name;
  PolygonMap map;
  double radius_m = 0.18;
  double cell_m = 0.05;  ///< cell size of the grid for the navigation mesh
};

double twice_area(const std::vector<Vec2>& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += cross(loop[i], loop[(i + 1) % loop.size()]);
  return sum;
}

/// Returns the corners of the loop that leaves `from` along `step`, with blocked cells to the left. Removes
/// its sides from `sides`.
std::vector<Vec2> loop_of(std::multimap<std::pair<int, int>, Cell>& sides, Cell from, Cell step) {
  std::vector<Vec2> corners;
  Cell at = from, last{};
  do {
    const auto [begin, end] = sides.equal_range({at.x, at.y});
    // At a corner where two loops touch, the loop turns left, around the same blocked cell.
    auto next = begin;
    for (auto side = begin; side != end; ++side) {
      if (side->second == (last == Cell{} ? step : Cell{-last.y, last.x})) next = side;
    }
    if (!(next->second == last)) corners.push_back({1.0 * at.x, 1.0 * at.y});
    last = next->second;
    at = {at.x + last.x, at.y + last.y};
    sides.erase(next);
  } while (!(at == from));
  return corners;
}

/// Returns the outlines of the blocked cells. The outline around the largest free area is the boundary.
PolygonMap outlines(const Grid<std::uint8_t>& grid) {
  std::multimap<std::pair<int, int>, Cell> sides;
  const auto blocked = [&](int x, int y) { return !grid.frame.contains({x, y}) || grid[{x, y}] != 0; };
  for (int y = 0; y <= grid.frame.height; ++y) {
    for (int x = 0; x <= grid.frame.width; ++x) {
      const bool here = blocked(x, y), below = blocked(x, y - 1), left = blocked(x - 1, y);
      if (here != below) sides.insert({{here ? x : x + 1, y}, {here ? 1 : -1, 0}});
      if (here != left) sides.insert({{x, here ? y + 1 : y}, {0, here ? -1 : 1}});
    }
  }
  PolygonMap map;
  double widest = 0.0;
  while (!sides.empty()) {
    const auto [x, y] = sides.begin()->first;
    std::vector<Vec2> loop = loop_of(sides, {x, y}, sides.begin()->second);
    const double area = twice_area(loop);
    if (area > 0.0) map.obstacles.push_back(std::move(loop));
    if (area >= widest) continue;
    widest = area;
    map.boundary = std::move(loop);
  }
  return map;
}

double best_us(int times, const auto& work) {
  double best = 1e300;
  for (int i = 0; i < times; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

struct Cost {
  double before_us = 0.0;  ///< extra time of the first query over its repetition
  double query_us = 0.0;   ///< mean over the answered queries
};

template <class Options>
Cost cost_of(Outcome<Plan> (*planner)(const Problem&, const Options&, const Budget&, Workspace&),
             const std::vector<Problem>& problems) {
  Cost cost;
  Workspace workspace;
  int answered = 0;
  for (const Problem& problem : problems) {
    if (!planner(problem, {}, {}, workspace)) continue;
    ++answered;
    cost.query_us += best_us(rounds, [&] { (void)planner(problem, {}, {}, workspace); });
  }
  const double first = best_us(rounds, [&] {
    Workspace fresh;
    (void)planner(problems.front(), {}, {}, fresh);
  });
  const double again = best_us(rounds, [&] { (void)planner(problems.front(), {}, {}, workspace); });
  cost.before_us = first - again;
  cost.query_us /= answered;
  return cost;
}

/// Returns the number of queries after which the graph costs less in total than no graph.
std::string paid_after(const Cost& graph, const Cost& none) {
  if (none.query_us <= graph.query_us) return "never";
  return fmt::format("{:.0f}", std::ceil(graph.before_us / (none.query_us - graph.query_us)));
}

void measure(const World& world) {
  Outcome<PolygonGround> made = bad_input("");
  const double ground_us = best_us(
      rounds, [&] { made = PolygonGround::of(world.map.boundary, world.map.obstacles, world.radius_m); });
  const auto ground = std::make_shared<const PolygonGround>(std::move(*made));
  auto blocked = blocked_for_disk(*ground, {.resolution_m = world.cell_m});
  const auto grid = std::make_shared<const GridMap>(*GridMap::of(*blocked, GridModel::corners));
  std::vector<Problem> problems, on_grid;
  for (const PointQuery& query : world.map.queries) {
    problems.push_back({nullptr, query.start, query.goal, ground});
    on_grid.push_back({grid, query.start, query.goal});
  }
  const Cost full = cost_of(visibility_graph, problems),
             reduced = cost_of(visibility_graph_reduced, problems);
  const Cost none = cost_of(visibility_graph_implicit, problems), mesh = cost_of(polyanya, on_grid);
  fmt::print(
      "| {} | {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.1f} | {} | {} | {:.0f} | {:.1f} |\n",
      world.name, ground->edges.size(), ground->arcs.size(), ground_us, full.before_us, reduced.before_us,
      full.query_us, reduced.query_us, none.query_us, paid_after(full, none), paid_after(reduced, none),
      mesh.before_us, mesh.query_us);
}

/// Returns solvable queries between random points.
std::vector<PointQuery> random_queries(const World& world, std::size_t count) {
  const auto ground = std::make_shared<const PolygonGround>(
      *PolygonGround::of(world.map.boundary, world.map.obstacles, world.radius_m));
  Rng rng = Rng(1).child("queries");
  Workspace workspace;
  std::vector<PointQuery> queries;
  while (queries.size() < count) {
    const auto point = [&] {
      const double x = rng.uniform(ground->bounds.low.x, ground->bounds.high.x);
      return Vec2{x, rng.uniform(ground->bounds.low.y, ground->bounds.high.y)};
    };
    const Vec2 start = point(), goal = point();
    if (visibility_graph_reduced({nullptr, start, goal, ground}, {}, {}, workspace)) {
      queries.push_back({start, goal});
    }
  }
  return queries;
}

int run(const std::string& data) {
  fmt::print(
      "| map | edges | arcs | ground | full graph | reduced graph | query: full | reduced | implicit | full "
      "pays "
      "after | reduced pays after | mesh | query: mesh |\n"
      "|:----|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (int number = 1; number <= 7; ++number) {
    const std::string name = fmt::format("map_{}", number);
    auto map = load_polygon_map(fmt::format("{}/polygons/{}.txt", data, name));
    if (!map) return fmt::print(stderr, "{}\n", to_string(map.error())), 2;
    measure({name, std::move(*map)});
  }
  auto grid = load_movingai_map(data + "/grids/dao/den312d.map");
  if (!grid) return fmt::print(stderr, "{}\n", to_string(grid.error())), 2;
  World den{"den312d", outlines(*grid), 0.25, 0.25};
  den.map.queries = random_queries(den, 50);
  measure(den);
  return 0;
}

}  // namespace
}  // namespace outrider

int main() {
  const char* data = std::getenv("OUTRIDER_DATA");
  if (data != nullptr) return outrider::run(data);
  fmt::print("bench_visibility: set OUTRIDER_DATA to the folder with polygons/ and grids/\n");
  return 0;
}
