#include "outrider/path/problem.hpp"

#include <fmt/format.h>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

std::string span_text(const Box2& box) {
  return fmt::format("x from {} to {} and y from {} to {}", short_number(box.low.x), short_number(box.high.x),
                     short_number(box.low.y), short_number(box.high.y));
}

Outcome<Cell> vertex(const GridMap& ground, Vec2 p, std::string_view name, FaultCode blocked) {
  const std::optional<Cell> v = ground.vertex_at(p);
  const std::string at = place_text(p.x, p.y);
  if (!v) {
    return fault(FaultCode::outside_map, fmt::format("the {} {} lies outside the map; take {}", name, at,
                                                     span_text(ground.frame.bounds())));
  }
  if (!ground.place(*v)) {
    return fault(blocked, fmt::format("the {} {} is blocked; move it to free ground, or take a finer "
                                      "resolution than {} m",
                                      name, at, short_number(ground.frame.resolution_m)));
  }
  return *v;
}

Status stands(const PolygonGround& ground, Vec2 p, std::string_view name, FaultCode blocked) {
  const std::string at = place_text(p.x, p.y);
  if (!ground.bounds.contains(p) || ground.outside(p)) {
    return fault(FaultCode::outside_map, fmt::format("the {} {} lies outside the boundary; it spans {}", name,
                                                     at, span_text(ground.bounds)));
  }
  if (ground.point_free(p)) return {};
  if (ground.solid(p)) {
    return fault(blocked, fmt::format("the {} {} lies inside an obstacle; move it to free ground", name, at));
  }
  return fault(blocked, fmt::format("the {} {} is {:.6g} m from the nearest edge, less than the robot's "
                                    "radius of {} m; move it away or take a smaller robot",
                                    name, at, ground.edge_distance(p), short_number(ground.radius_m)));
}

}  // namespace

Outcome<GridQuery> grid_query(const Problem& problem) {
  if (!problem.grid) {
    return bad_input(problem.polygons
                         ? "the ground is polygons; this planner needs a grid, take one that works "
                           "on polygons, such as visibility_graph"
                         : "the problem has no grid; this planner needs one as its ground");
  }
  auto start = vertex(*problem.grid, problem.start, "start", FaultCode::start_blocked);
  if (!start) return pass_on(start);
  auto goal = vertex(*problem.grid, problem.goal, "goal", FaultCode::goal_blocked);
  if (!goal) return pass_on(goal);
  return GridQuery{*problem.grid, *start, *goal};
}

Outcome<std::shared_ptr<const PolygonGround>> polygon_query(const Problem& problem) {
  if (!problem.polygons) {
    return bad_input(problem.grid ? fmt::format("the ground is a grid of the model {}; this planner needs "
                                                "polygons, take one that works on grids, such as theta_star",
                                                to_string(problem.grid->model))
                                  : "the problem has no polygons; this planner needs them as its ground");
  }
  const PolygonGround& ground = *problem.polygons;
  if (auto start = stands(ground, problem.start, "start", FaultCode::start_blocked); !start) {
    return pass_on(start);
  }
  if (auto goal = stands(ground, problem.goal, "goal", FaultCode::goal_blocked); !goal) return pass_on(goal);
  return problem.polygons;
}

}  // namespace outrider
