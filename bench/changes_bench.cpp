// Measures what a map change costs each planner that keeps an index. A block of 3 x 3 cells, or an obstacle,
// appears and disappears by turns, and a query whose start is its goal updates the index. `followed` keeps
// the workspace, `anew` uses a new one; `ground` makes only the ground. `polyanya/query` asks for paths
// between random places after 64 blocks have appeared one by one, on the updated mesh or on a new one. Grids
// of MovingAI are read from $OUTRIDER_DATA/grids if that is set.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {
namespace {

constexpr int block = 3;
constexpr std::size_t places = 32;

/// Holds problems: those with an even index have the original map, those with an odd index have one change.
struct Changing {
  std::vector<Problem> problems;
  std::size_t next = 0;

  const Problem& turn() { return problems[next++ % problems.size()]; }
};

/// Returns a problem whose answer needs no search.
Problem at_rest(std::shared_ptr<const GridMap> ground) {
  Cell v;
  while (!ground->place(v)) v = v.x < ground->frame.width ? Cell{v.x + 1, v.y} : Cell{0, v.y + 1};
  const Vec2 p = ground->point(v);
  return {std::move(ground), p, p};
}

/// Returns a block of mostly free cells, far from the first free cell.
CellChange some_block(Rng& rng, const GridMap& ground) {
  for (;;) {
    const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
    const CellChange change{
        {below(ground.frame.width - block), block + below(ground.frame.height - 2 * block)},
        block,
        block,
        true};
    int free = 0;
    for (int i = 0; i < block * block; ++i) {
      free += ground.blocked({change.low.x + i % block, change.low.y + i / block}) ? 0 : 1;
    }
    if (2 * free > block * block) return change;
  }
}

Changing changing_grid(const Grid<std::uint8_t>& blocked, GridModel model) {
  Rng rng = Rng(3).child("blocks");
  const auto base = std::make_shared<const GridMap>(GridMap::of(blocked, model).value());
  Changing changing;
  for (std::size_t i = 0; i < places; ++i) {
    changing.problems.push_back(at_rest(base));
    changing.problems.push_back(
        at_rest(std::make_shared<const GridMap>(base->with({some_block(rng, *base)}).value())));
  }
  return changing;
}

/// Returns `count` squares and triangles, scattered over a square of 100 m.
PolygonGround strewn(int count) {
  Rng rng = Rng(4).child("obstacles");
  std::vector<std::vector<Vec2>> obstacles;
  for (int i = 0; i < count; ++i) {
    const Vec2 centre{rng.uniform(0, 100), rng.uniform(0, 100)};
    const double size = rng.uniform(1, 5), turn = rng.uniform(0, 2 * pi);
    const int corners = 3 + i % 2;
    std::vector<Vec2> polygon;
    for (int k = 0; k < corners; ++k)
      polygon.push_back(centre + size * direction(turn + 2 * pi * k / corners));
    obstacles.push_back(polygon);
  }
  return PolygonGround::of({{-5, -5}, {105, -5}, {105, 105}, {-5, 105}}, obstacles, 0.18).value();
}

Changing changing_polygons(int count) {
  const PolygonGround base = strewn(count);
  const auto shared = std::make_shared<const PolygonGround>(base);
  Changing changing;
  const Vec2 rest{-4, -4};
  for (std::size_t i = 0; i < std::min<std::size_t>(places, base.obstacles.size()); ++i) {
    changing.problems.push_back({nullptr, rest, rest, shared});
    const auto without = std::make_shared<const PolygonGround>(base.without_obstacle(i).value());
    changing.problems.push_back({nullptr, rest, rest, without});
  }
  return changing;
}

void follow(benchmark::State& state, const ConfiguredPlanner& planner, Changing& changing) {
  Workspace workspace;
  benchmark::DoNotOptimize(planner.plan(changing.turn(), {}, workspace));
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(planner.plan(changing.turn(), {}, workspace));
  }
}

void make_anew(benchmark::State& state, const ConfiguredPlanner& planner, Changing& changing) {
  for ([[maybe_unused]] auto _ : state) {
    Workspace workspace;
    benchmark::DoNotOptimize(planner.plan(changing.turn(), {}, workspace));
  }
}

/// Measures queries between random places on a grid to which blocks were added. The workspace has seen all
/// blocks (`all`), or only the final map.
void ask(benchmark::State& state, const ConfiguredPlanner& planner, const Grid<std::uint8_t>& blocked,
         bool all) {
  constexpr int blocks = 64, queries = 300;
  Rng rng = Rng(5).child("queries");
  auto ground = std::make_shared<const GridMap>(GridMap::of(blocked, GridModel::corners).value());
  const auto point = [&] {
    return Vec2{rng.uniform(0, blocked.frame.width), rng.uniform(0, blocked.frame.height)};
  };
  Workspace workspace;
  for (int i = 0; i <= blocks; ++i) {
    if (all || i == blocks) benchmark::DoNotOptimize(planner.plan(at_rest(ground), {}, workspace));
    if (i < blocks)
      ground = std::make_shared<const GridMap>(ground->with({some_block(rng, *ground)}).value());
  }
  Changing asked;
  while (asked.problems.size() < queries) {
    Problem problem{ground, point(), point()};
    if (planner.plan(problem, {}, workspace)) asked.problems.push_back(std::move(problem));
  }
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(planner.plan(asked.turn(), {}, workspace));
}

template <class Run>
void add(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond);
}

void add_planners(const std::string& map, const std::shared_ptr<Changing>& changing, bool polygons,
                  GridModel model) {
  for (const PathPlanner& row : path_planners()) {
    const bool keeps = row.index || row.name == "jps" || row.name == "polyanya";
    if (!keeps || row.polygons != polygons || (!polygons && !row.takes(model))) continue;
    const std::string name = fmt::format("{}/{}", map, row.name);
    const ConfiguredPlanner planner = row.configure();
    add(name + "/followed", [planner, changing](benchmark::State& s) { follow(s, planner, *changing); });
    add(name + "/anew", [planner, changing](benchmark::State& s) { make_anew(s, planner, *changing); });
  }
}

void add_grid(const std::string& name, const std::string& file) {
  const auto map = std::make_shared<Grid<std::uint8_t>>(load_movingai_map(file).value());
  for (const GridModel model : {GridModel::cells, GridModel::corners}) {
    add_planners(name, std::make_shared<Changing>(changing_grid(*map, model)), false, model);
  }
  const ConfiguredPlanner planner = find_path_planner("polyanya")->configure();
  for (const bool all : {true, false}) {
    add(fmt::format("{}/polyanya/query/{}", name, all ? "followed" : "anew"),
        [planner, map, all](benchmark::State& s) { ask(s, planner, *map, all); });
  }
  add(name + "/ground/with", [map](benchmark::State& state) {
    Rng rng = Rng(3).child("with");
    const GridMap base = GridMap::of(*map, GridModel::cells).value();
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(base.with({some_block(rng, base)}));
  });
  add(name + "/ground/anew", [map](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(GridMap::of(*map, GridModel::cells));
  });
}

void add_polygons(int count) {
  const std::string name = fmt::format("strewn{}", count);
  add_planners(name, std::make_shared<Changing>(changing_polygons(count)), true, GridModel::cells);
  add(name + "/ground/without", [count](benchmark::State& state) {
    const PolygonGround base = strewn(count);
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(base.without_obstacle(0));
  });
}

const bool registered = [] {
  if (const char* data = std::getenv("OUTRIDER_DATA")) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(data) + "/grids")) {
      const std::string file = entry.path().filename().string();
      for (const std::string name : {"lak303d", "orz900d", "Aurora"}) {
        if (file == name + ".map.gz" || file == name + ".map") add_grid(name, entry.path().string());
      }
    }
  }
  for (const int count : {30, 100, 300}) add_polygons(count);
  return true;
}();

}  // namespace
}  // namespace outrider
