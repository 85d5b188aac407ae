// Shows the reasons of refusals: a start inside an obstacle, an unreachable goal, an unknown name.
#include <fmt/format.h>

#include <memory>

#include "outrider/path/catalog.hpp"
#include "outrider/path/grid/theta_star.hpp"

using namespace outrider;

int main() {
  Grid<std::uint8_t> occupied(GridFrame{{0.0, 0.0}, 1.0, 9, 5});
  for (int y = 0; y < 5; ++y) occupied[{4, y}] = 1;
  auto ground = GridMap::of(occupied, GridModel::cells);
  if (!ground) return 1;
  const auto shared = std::make_shared<const GridMap>(std::move(*ground));

  Workspace workspace;
  const auto ask = [&](Vec2 start, Vec2 goal) {
    const auto plan = theta_star({shared, start, goal}, {}, {}, workspace);
    fmt::print("{}\n", plan ? "found" : to_string(plan.error().code));
  };
  ask({0.5, 0.5}, {3.5, 3.5});
  ask({0.5, 0.5}, {8.5, 3.5});
  ask({4.5, 0.5}, {8.5, 3.5});
  ask({0.5, 0.5}, {99.0, 0.5});
  if (const auto planner = find_path_planner("dijkstar"); !planner) {
    fmt::print("{}\n", to_string(planner.error()));
  }
}

// Prints:
// found
// no_path
// start_blocked
// outside_map
// planner: there is no planner 'dijkstar'; did you mean 'dijkstra'?
