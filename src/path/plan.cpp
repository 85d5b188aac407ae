#include "outrider/path/plan.hpp"

#include <cmath>

namespace outrider {
namespace {

bool goes_straight(Cell a, Cell b, Cell c) {
  const std::int64_t ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
  return ux * vy == uy * vx && ux * vx + uy * vy > 0;
}

}  // namespace

double length_of(const PathPiece& piece) {
  if (piece.turn_rad == 0.0) return distance(piece.from, piece.to);
  return std::abs(piece.turn_rad) * distance(piece.centre, piece.from);
}

Plan plan_along(const Problem& problem, const std::vector<Cell>& vertices, double cost, double lower_bound,
                const PlanCounters& counters) {
  Plan plan;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const bool inner = i > 0 && i + 1 < vertices.size();
    if (inner && goes_straight(plan.vertices.back(), vertices[i], vertices[i + 1])) continue;
    plan.vertices.push_back(vertices[i]);
    plan.waypoints.push_back(problem.grid->point(vertices[i]));
  }
  plan.cost = cost;
  plan.lower_bound = lower_bound;
  plan.reached_within = distance(plan.waypoints.back(), problem.goal);
  plan.counters = counters;
  return plan;
}

}  // namespace outrider
