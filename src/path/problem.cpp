#include "outrider/path/problem.hpp"

#include <fmt/format.h>

namespace outrider {
namespace {

Outcome<Cell> vertex(const GridGround& ground, Vec2 p, std::string_view name, FaultCode blocked) {
  const std::optional<Cell> v = ground.vertex_at(p);
  const Box2 bounds = ground.frame.bounds();
  if (!v) {
    return fault(FaultCode::outside_map,
                 fmt::format("the {} ({}, {}) lies outside the map; take x from {} to {} and y from {} to {}",
                             name, p.x, p.y, bounds.low.x, bounds.high.x, bounds.low.y, bounds.high.y));
  }
  if (!ground.place(*v)) {
    return fault(blocked, fmt::format("the {} ({}, {}) is blocked; move it to free ground, or take a finer "
                                      "resolution than {} m",
                                      name, p.x, p.y, ground.frame.resolution_m));
  }
  return *v;
}

}  // namespace

Outcome<GridQuery> grid_query(const Problem& problem) {
  if (!problem.grid) return bad_input("the problem has no grid; this planner needs one as its ground");
  auto start = vertex(*problem.grid, problem.start, "start", FaultCode::start_blocked);
  if (!start) return pass_on(start);
  auto goal = vertex(*problem.grid, problem.goal, "goal", FaultCode::goal_blocked);
  if (!goal) return pass_on(goal);
  return GridQuery{*problem.grid, *start, *goal};
}

}  // namespace outrider
