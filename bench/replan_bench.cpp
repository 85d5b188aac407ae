// Measures planners on a drive through a map that turns out otherwise. The robot drives along shortest paths
// on the grid it believes in, sees the cells within `sight` of it, and plans again whenever one of them is
// not as it believed. It believes that the whole map is free (`unknown`), or it knows a published map but not
// the blocks of 3 x 3 cells that were strewn over it (`strewn`). All planners get the same problems, each in
// a workspace that it keeps, or in a new one at each step (`anew`); the change of the GridMap itself is not
// in their times. Reads grids of MovingAI from $OUTRIDER_DATA/grids, and prints the table of
// docs/benchmarks/path.md. Each time is the shortest of several rounds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>

#include "outrider/core/rng.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {
namespace {

constexpr int rounds = 3;
constexpr int sight = 10;  // cells along each axis

/// One plan of the drive: from where, and what the robot saw just before.
struct Step {
  Cell at;
  std::vector<CellChange> seen;
};

struct Drive {
  Grid<std::uint8_t> believed;
  Cell goal;
  std::vector<Step> steps;
};

using Ground = std::shared_ptr<const GridMap>;

Ground with(const Ground& ground, const std::vector<CellChange>& changes) {
  return changes.empty() ? ground : std::make_shared<const GridMap>(ground->with(changes).value());
}

std::vector<CellChange> seen_from(Cell at, const GridMap& truth, const GridMap& believed) {
  std::vector<CellChange> seen;
  for (int y = at.y - sight; y <= at.y + sight; ++y) {
    for (int x = at.x - sight; x <= at.x + sight; ++x) {
      const bool blocked = truth.blocked({x, y});
      if (blocked != believed.blocked({x, y})) seen.push_back({{x, y}, 1, 1, blocked});
    }
  }
  return seen;
}

/// Drives from start to goal; the steps are those at which the robot plans again.
Drive drive(const Grid<std::uint8_t>& truth, Grid<std::uint8_t> believed, Cell start, Cell goal) {
  const GridMap real = GridMap::of(truth, GridModel::cells).value();
  Drive drive{std::move(believed), goal, {}};
  Ground ground = std::make_shared<const GridMap>(GridMap::of(drive.believed, GridModel::cells).value());
  const ConfiguredPlanner planner = find_path_planner("jps")->configure();
  Workspace workspace;
  std::vector<Cell> way;
  for (Cell at = start; !(at == goal);) {
    auto seen = seen_from(at, real, *ground);
    if (way.empty() || !seen.empty()) {
      ground = with(ground, seen);
      drive.steps.push_back({at, std::move(seen)});
      auto plan = planner.plan({ground, ground->point(at), ground->point(goal)}, {}, workspace);
      if (!plan) break;
      way = {plan->vertices.rbegin(), plan->vertices.rend() - 1};
    }
    const Cell to = way.back();
    at = {at.x + std::clamp(to.x - at.x, -1, 1), at.y + std::clamp(to.y - at.y, -1, 1)};
    if (at == to) way.pop_back();
  }
  return drive;
}

struct Measured {
  std::vector<double> us;  // by step
  double expansions = 0.0;
};

void measure(const Drive& drive, const PathPlanner& row, bool keep, Measured& least) {
  const GridModel model = row.takes(GridModel::cells) ? GridModel::cells : GridModel::corners;
  const ConfiguredPlanner planner = row.configure();
  Ground ground = std::make_shared<const GridMap>(GridMap::of(drive.believed, model).value());
  Workspace kept;
  std::uint64_t expansions = 0;
  for (std::size_t i = 0; i < drive.steps.size(); ++i) {
    ground = with(ground, drive.steps[i].seen);
    const Problem problem{ground, ground->point(drive.steps[i].at), ground->point(drive.goal)};
    Workspace fresh;
    const auto begin = std::chrono::steady_clock::now();
    const auto plan = planner.plan(problem, {}, keep ? kept : fresh);
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    if (least.us.size() <= i) least.us.push_back(time.count());
    least.us[i] = std::min(least.us[i], time.count());
    expansions += plan ? plan->counters.expansions : 0;
  }
  least.expansions = static_cast<double>(expansions) / static_cast<double>(drive.steps.size());
}

void compare(const std::string& name, const Drive& drive) {
  struct Contender {
    const char* planner;
    bool keep;
  };
  for (const auto& [planner, keep] : {Contender{"d_star_lite", true},
                                      {"d_star_lite", false},
                                      {"a_star", true},
                                      {"jps", true},
                                      {"polyanya", true},
                                      {"polyanya", false}}) {
    Measured least;
    const PathPlanner row = find_path_planner(planner).value();
    for (int round = 0; round < rounds; ++round) measure(drive, row, keep, least);
    const double first = least.us.front(), sum = std::accumulate(least.us.begin() + 1, least.us.end(), 0.0);
    const auto replans = static_cast<double>(least.us.size() - 1);
    fmt::print("| {:<22} | {:>7} | {:<17} | {:>8.0f} | {:>8.1f} | {:>8.0f} | {:>10.0f} |\n", name, replans,
               fmt::format("{}{}", planner, keep ? "" : ", anew"), first, sum / replans,
               *std::max_element(least.us.begin() + 1, least.us.end()), least.expansions);
  }
}

/// Returns the map with a block for every 300 cells.
Grid<std::uint8_t> with_blocks(Grid<std::uint8_t> map) {
  Rng rng = Rng(8).child("blocks");
  const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
  for (std::size_t i = 0; i < map.cells.size() / 300; ++i) {
    const Cell low{below(map.frame.width - 2), below(map.frame.height - 2)};
    for (int k = 0; k < 9; ++k) map[{low.x + k % 3, low.y + k / 3}] = 1;
  }
  return map;
}

/// Returns two cells that are joined, and the farthest from each other of 60 such pairs.
std::pair<Cell, Cell> ends(const Grid<std::uint8_t>& map) {
  Rng rng = Rng(9).child("ends");
  const auto ground = std::make_shared<const GridMap>(GridMap::of(map, GridModel::cells).value());
  const auto some = [&] {
    return Cell{static_cast<int>(rng.below(static_cast<std::uint64_t>(map.frame.width))),
                static_cast<int>(rng.below(static_cast<std::uint64_t>(map.frame.height)))};
  };
  std::pair<Cell, Cell> longest;
  double most = 0.0;
  for (int found = 0; found < 60;) {
    const Cell a = some(), b = some();
    const auto plan = plan_path({ground, ground->point(a), ground->point(b)}, "jps");
    if (!plan) continue;
    ++found;
    if (plan->cost <= most) continue;
    most = plan->cost;
    longest = {a, b};
  }
  return longest;
}

void run(const std::string& data) {
  fmt::print("| map | replans | planner | first us | mean us | worst us | expansions |\n");
  for (const std::string file : {"dao/lak303d", "dao/orz900d", "rooms/8room_000", "random/random512-10-0"}) {
    auto map = load_movingai_map(fmt::format("{}/grids/{}.map", data, file));
    if (!map) map = load_movingai_map(fmt::format("{}/grids/{}.map.gz", data, file));
    if (!map) continue;
    const std::string name = file.substr(file.find('/') + 1);
    for (const bool strewn : {false, true}) {
      const Grid<std::uint8_t> truth = strewn ? with_blocks(*map) : *map;
      const auto [start, goal] = ends(truth);
      const Drive driven = drive(truth, strewn ? *map : Grid<std::uint8_t>(map->frame), start, goal);
      compare(fmt::format("{}, {}", name, strewn ? "strewn" : "unknown"), driven);
    }
  }
}

}  // namespace
}  // namespace outrider

int main() {
  const char* data = std::getenv("OUTRIDER_DATA");
  outrider::run(data == nullptr ? "../shared/data" : data);
}
