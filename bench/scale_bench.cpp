// Measures every planner of short paths on large generated maps: making the ground, the first query with all
// that it builds, the same query again, and memory. Prints the table of docs/benchmarks/path.md.
//
//   bench_scale [side ...] [rooms] [caves] [planner ...]
//
// Sides are multiples of 32 up to 16384, 4096 unless given; all maps and planners unless some are named.
// Each planner runs in a process of its own, which the clock stops after a minute. The query goes from one
// corner of the map to the other. Every path is checked, and planners that promise the shortest of the same
// paths must agree.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"

namespace outrider {
namespace {

using Blocked = Grid<std::uint8_t>;

constexpr std::chrono::seconds most_time{60};
constexpr double mib = 1 << 20U;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Rooms of 31 x 31 cells; each wall has a door of three cells.
Blocked rooms(int side) {
  constexpr int pitch = 32, door = 3;
  Rng rng = Rng(1).child("rooms");
  Blocked grid(GridFrame{{}, 1.0, side, side});
  const auto wall = [&](Cell low, Cell step) {
    const int gap = static_cast<int>(rng.below(pitch - door));
    for (int k = 0; k < pitch; ++k) {
      if (k < gap || k >= gap + door) grid[{low.x + k * step.x, low.y + k * step.y}] = 1;
    }
  };
  for (int y = 0; y < side; y += pitch) {
    for (int x = 0; x < side; x += pitch) {
      wall({x, y}, {1, 0});
      wall({x, y}, {0, 1});
    }
  }
  return grid;
}

/// Caves: random cells, of which each takes the value of most cells around it, four times.
Blocked caves(int side) {
  constexpr int steps = 4;
  constexpr double density = 0.42;
  Rng rng = Rng(2).child("caves");
  Blocked grid(GridFrame{{}, 1.0, side, side});
  for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < density ? 1 : 0;
  for (int step = 0; step < steps; ++step) {
    Blocked next = grid;
    for (int y = 1; y + 1 < side; ++y) {
      for (int x = 1; x + 1 < side; ++x) {
        int blocked = 0;
        for (int k = 0; k < 9; ++k) blocked += grid[{x + k % 3 - 1, y + k / 3 - 1}];
        next[{x, y}] = blocked > 4 ? 1 : 0;
      }
    }
    grid = std::move(next);
  }
  return grid;
}

/// Returns the free place nearest to `near` to its upper right, on the diagonal first.
Cell free_place(const GridMap& ground, Cell near) {
  while (!ground.place(near)) near = {near.x + 1, near.y + (near.x % 2 == 0 ? 1 : 0)};
  return near;
}

/// Returns a line of /proc/self/status, MiB.
double memory_mib(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return std::atof(line.c_str() + name.size() + 1) / 1024.0;
  }
  return 0.0;
}

struct Measured {
  bool ended = false;  ///< within the time
  bool found = false, legal = false;
  double first_s = 0.0, again_s = 0.0, mib = 0.0, cost = 0.0;
};

Measured measure(const PathPlanner& planner, const Problem& problem) {
  std::stop_source stop;
  std::jthread clock([&](const std::stop_token& done) {
    const auto begin = std::chrono::steady_clock::now();
    while (!done.stop_requested() && std::chrono::steady_clock::now() - begin < most_time)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop.request_stop();
  });
  Budget budget;
  budget.stop = stop.get_token();
  Workspace workspace;
  const ConfiguredPlanner configured = planner.configure();
  const double before = memory_mib("VmRSS");
  Measured measured;
  auto begin = std::chrono::steady_clock::now();
  const auto plan = configured.plan(problem, budget, workspace);
  measured.first_s = seconds_since(begin);
  measured.mib = memory_mib("VmHWM") - before;
  measured.ended = plan.has_value() || plan.error().code == FaultCode::no_path;
  if (!plan) return measured;
  measured.found = true;
  measured.cost = plan->cost;
  measured.legal = check(*plan, problem).has_value();
  begin = std::chrono::steady_clock::now();
  const auto again = configured.plan(problem, budget, workspace);
  measured.again_s = again ? seconds_since(begin) : std::nan("");
  return measured;
}

/// Measures in a process of its own; not ended if that one dies.
Measured measured_apart(const PathPlanner& planner, const Problem& problem) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    const Measured measured = measure(planner, problem);
    ::_exit(::write(ends[1], &measured, sizeof measured) == sizeof measured ? 0 : 1);
  }
  ::close(ends[1]);
  Measured measured;
  if (::read(ends[0], &measured, sizeof measured) != sizeof measured) measured = {};
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return measured;
}

void print(const std::string& map, const PathPlanner& planner, const Measured& m, double cells) {
  const std::string memory = fmt::format("{:.0f} | {:.2f}", m.mib, m.mib * mib / cells);
  if (!m.ended) {
    fmt::print("| {} | `{}` | over {} s | | {} |\n", map, planner.name, most_time.count(), memory);
  } else {
    const std::string again = std::isnan(m.again_s) ? "" : fmt::format("{:.3f}", m.again_s);
    fmt::print("| {} | `{}` | {:.3f} | {} | {} |\n", map, planner.name, m.first_s, again, memory);
  }
  std::fflush(stdout);
}

/// The maps and planners that are measured.
struct Selection {
  std::vector<int> sides;
  std::vector<std::string> maps, planners;

  static bool holds(const std::vector<std::string>& names, std::string_view name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
  }
};

/// Returns the number of answers that are wrong.
int run(const Selection& selection, const std::string& name, const Blocked& grid) {
  int wrong = 0;
  const int side = grid.frame.width;
  for (const GridModel model : {GridModel::cells, GridModel::corners}) {
    const auto begin = std::chrono::steady_clock::now();
    const auto ground = std::make_shared<const GridMap>(GridMap::of(grid, model).value());
    fmt::print("| {} | ground of {} | {:.3f} | | {:.0f} | 2.00 |\n", name, to_string(model),
               seconds_since(begin), 2.0 * static_cast<double>(ground->marks.size()) / mib);
    const Problem problem{ground, ground->point(free_place(*ground, {side / 16, side / 16})),
                          ground->point(free_place(*ground, {side - side / 16, side - side / 16}))};
    double shortest = 0.0;
    for (const PathPlanner& planner : path_planners()) {
      const bool any_direction = planner.guarantee.among == PathClass::any_direction;
      if (planner.guarantee.measure != Measure::length || planner.steers || !planner.takes(model) ||
          any_direction != (model == GridModel::corners) ||
          !Selection::holds(selection.planners, planner.name))
        continue;
      const Measured measured = measured_apart(planner, problem);
      print(name, planner, measured, static_cast<double>(grid.frame.size()));
      if (!measured.found) continue;
      const bool optimal = planner.guarantee.most_ratio == 1.0;
      if (optimal && shortest == 0.0) shortest = measured.cost;
      wrong += measured.legal && (!optimal || std::abs(measured.cost - shortest) <= 1e-9 * shortest) ? 0 : 1;
    }
  }
  return wrong;
}

int run_all(const Selection& selection) {
  int wrong = 0;
  fmt::print(
      "| map | planner | first query s | again s | MiB | bytes a cell |\n|:---|:---|---:|---:|---:|---:|\n");
  for (const int side : selection.sides) {
    for (const auto& [name, make] : {std::pair{"rooms", &rooms}, std::pair{"caves", &caves}}) {
      if (Selection::holds(selection.maps, name))
        wrong += run(selection, fmt::format("{} {}", name, side), make(side));
    }
  }
  if (wrong > 0) fmt::print(stderr, "{} answers are wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}

/// Adds what an argument names; returns false if it names nothing.
bool add(const std::string& argument, Selection& selection) {
  if (argument == "rooms" || argument == "caves") {
    selection.maps.push_back(argument);
    return true;
  }
  if (find_path_planner(argument)) {
    selection.planners.push_back(argument);
    return true;
  }
  selection.sides.push_back(std::atoi(argument.c_str()));
  return selection.sides.back() >= 64 && selection.sides.back() <= 16384 && selection.sides.back() % 32 == 0;
}

}  // namespace
}  // namespace outrider

int main(int count, char** arguments) {
  outrider::Selection selection;
  for (int i = 1; i < count; ++i) {
    if (outrider::add(arguments[i], selection)) continue;
    fmt::print(stderr,
               "'{}' is not valid; expected a multiple of 32 from 64 to 16384, rooms, caves or a planner\n",
               arguments[i]);
    return 2;
  }
  if (selection.sides.empty()) selection.sides = {4096};
  return outrider::run_all(selection);
}
