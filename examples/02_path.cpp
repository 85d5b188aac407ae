// Plans a path around a wall with two planners of the catalogue, verified by check().
#include <fmt/format.h>

#include <memory>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"

using namespace outrider;

int main() {
  // 60 x 40 cells of 0.1 m; a wall from the top leaves a gap at the bottom.
  Grid<std::uint8_t> occupied(GridFrame{{0.0, 0.0}, 0.1, 60, 40});
  for (int y = 10; y < 40; ++y) occupied[{30, y}] = 1;

  auto ground = GridMap::of(occupied, GridModel::cells);
  if (!ground) return 1;
  const Problem problem{std::make_shared<const GridMap>(std::move(*ground)), {0.55, 3.55}, {5.55, 3.55}};

  for (const char* name : {"a_star", "theta_star"}) {
    const auto planner = find_path_planner(name);
    if (!planner) return 1;
    Workspace workspace;
    const auto plan = planner->configure().plan(problem, {}, workspace);
    if (!plan) return 1;
    fmt::print("{}: {:.3f} m in {} legs, no shorter than {:.3f} m; {}\n", name, plan->cost,
               plan->waypoints.size() - 1, plan->lower_bound, check(*plan, problem) ? "checked" : "wrong");
  }
}

// Prints:
// a_star: 7.388 m in 5 legs, no shorter than 7.388 m; checked
// theta_star: 7.277 m in 3 legs, no shorter than 5.000 m; checked
