#include <cmath>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "yard/way_around.hpp"

namespace outrider {
namespace {

/// The cell among the nine around a place that can be driven to and is seen from it; its index, or size().
std::size_t cell_seen_from(const FiringMap& firing_map, Vec2 place, double radius_m) {
  const Cell home = firing_map.frame.cell_at(place);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell c{home.x + dx, home.y + dy};
      if (!firing_map.frame.contains(c) || firing_map.reachable[firing_map.frame.index(c)] == 0) continue;
      if (firing_map.ground.segment_free({place, firing_map.frame.centre(c)}, radius_m))
        return firing_map.frame.index(c);
    }
  }
  return firing_map.frame.size();
}

/// The cells where a way from a place to the start must bend: each is the last that sees the one before.
std::vector<Vec2> way_home(const FiringMap& firing_map, Vec2 place, double radius_m) {
  std::size_t cell = cell_seen_from(firing_map, place, radius_m);
  if (cell == firing_map.frame.size()) return {};
  std::vector<Vec2> bends{firing_map.place(cell)};
  while (firing_map.homeward[cell] != cell) {
    const std::size_t next = firing_map.homeward[cell];
    if (!firing_map.ground.segment_free({bends.back(), firing_map.place(next)}, radius_m))
      bends.push_back(firing_map.place(cell));
    cell = next;
  }
  bends.push_back(firing_map.place(cell));
  return bends;
}

bool all_connected(const Routes& routes, std::size_t stops) {
  for (std::size_t i = 0; i < stops; ++i) {
    for (std::size_t j = i + 1; j < stops; ++j) {
      if (!std::isfinite(routes.between(i, j).time_s)) return false;
    }
  }
  return true;
}

}  // namespace

Outcome<Routes> yard_routes(const GuardProblem& problem, const FiringMap& firing_map,
                            const std::vector<Vec2>& stops, const Budget& budget) {
  const auto& corners = firing_map.corners;
  auto routes = corners && corners->robot().radius_m == problem.robot.radius_m
                    ? routes_between(*corners, stops, budget)
                    : routes_between(firing_map.ground, problem.robot, stops, {}, {}, budget);
  if (!routes) return routes;
  if (all_connected(*routes, stops.size())) return routes;
  // The first stop joins them as a node, and the start, where all ways home meet.
  std::vector<Vec2> bends{stops[0], problem.start.position};
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (i > 0 && std::isfinite(routes->between(0, i).time_s)) continue;
    const auto way = way_home(firing_map, stops[i], problem.robot.radius_m);
    bends.insert(bends.end(), way.begin(), way.end());
  }
  return routes_between(firing_map.ground, problem.robot, stops, bends, {}, budget);
}

Outcome<std::vector<Vec2>> yard_way(const GuardProblem& problem, const FiringMap& firing_map,
                                    const std::optional<Routes>& routes, const Pose2& from, Vec2 to,
                                    const Budget& budget) {
  if (routes) {
    auto route = routes->route(from, to, budget);
    if (route) return std::move(route->waypoints);
    if (route.error().code == FaultCode::budget_exhausted) return pass_on(route);
  }
  auto along_grid = yard_routes(problem, firing_map, {from.position, to}, budget);
  if (along_grid) return along_grid->waypoints(0, 1);
  if (along_grid.error().code == FaultCode::budget_exhausted) return pass_on(along_grid);
  return std::vector<Vec2>{};
}

std::optional<std::vector<Vec2>> way_around(const GuardProblem& problem, const FiringMap& firing_map,
                                            Vec2 from, Vec2 to, const std::vector<Vec2>& standing,
                                            double gap_m, const Budget& budget) {
  const double radius_m = problem.robot.radius_m;
  std::vector<RoundedPolygon> obstacles = firing_map.ground.obstacles();
  for (const Vec2 middle : standing) obstacles.push_back({{middle}, gap_m - radius_m});
  const CollisionMap ground(firing_map.ground.bounds(), std::move(obstacles), problem.world.terrain);
  std::vector<Vec2> bends = way_home(firing_map, from, radius_m);
  const auto others = way_home(firing_map, to, radius_m);
  bends.insert(bends.end(), others.begin(), others.end());
  const auto routes = routes_between(ground, problem.robot, {from, to}, bends, {}, budget);
  if (!routes) return std::nullopt;
  auto way = routes->waypoints(0, 1);
  return way.empty() ? std::nullopt : std::optional(std::move(way));
}

}  // namespace outrider
