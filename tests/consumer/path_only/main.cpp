#include <iostream>
#include <memory>
#include <outrider/path/catalog.hpp>
#include <outrider/path/check.hpp>

int main() {
  // 60 x 40 cells of 0.1 m; a wall from the top leaves a gap at the bottom.
  outrider::Grid<std::uint8_t> occupied(outrider::GridFrame{{0.0, 0.0}, 0.1, 60, 40});
  for (int y = 10; y < 40; ++y) occupied[{30, y}] = 1;
  auto ground = outrider::GridMap::of(occupied, outrider::GridModel::cells);
  if (!ground) return 1;

  const outrider::Problem problem{
      std::make_shared<const outrider::GridMap>(std::move(*ground)), {0.55, 3.55}, {5.55, 3.55}};
  const auto planner = outrider::find_path_planner("theta_star");
  if (!planner) return 1;
  outrider::Workspace workspace;
  const auto plan = planner->configure().plan(problem, {}, workspace);
  if (!plan || !check(*plan, problem)) return 1;
  std::cout << plan->cost << " m in " << plan->waypoints.size() - 1 << " legs\n";
}
