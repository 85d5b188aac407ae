#include "outrider/path/plan.hpp"

#include <cmath>

namespace outrider {
namespace {

/// Returns true if b equals a or c, or if the direction does not change there.
bool goes_straight(Cell a, Cell b, Cell c) {
  const std::int64_t ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
  const bool in_line = ux * vy == uy * vx, onward = ux * vx + uy * vy >= 0;
  return in_line && onward;
}

/// Keeps both ends and the vertices at which the direction changes. Compares without a branch, because a
/// processor could not predict it.
void keep_turns(std::vector<Cell>& vertices) {
  if (vertices.size() < 3) return;
  std::size_t last = 0;  // of those that are kept
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const Cell here = vertices[i];
    const bool turns = !goes_straight(vertices[last], here, vertices[i + 1]);
    vertices[last + 1] = turns ? here : vertices[last + 1];
    last += turns ? 1 : 0;
  }
  vertices[last + 1] = vertices.back();
  vertices.resize(last + 2);
  if (vertices.capacity() > 4 * vertices.size()) vertices.shrink_to_fit();
}

Vec2 direction_at(const PathPiece& piece, Vec2 p) {
  if (piece.turn_rad == 0.0) return piece.to - piece.from;
  return piece.turn_rad > 0.0 ? perpendicular(p - piece.centre) : -1.0 * perpendicular(p - piece.centre);
}

}  // namespace

double length_of(const PathPiece& piece) {
  if (piece.turn_rad == 0.0) return distance(piece.from, piece.to);
  return std::abs(piece.turn_rad) * distance(piece.centre, piece.from);
}

double turn_between(const PathPiece& piece, const PathPiece& next) {
  const Vec2 ends = direction_at(piece, piece.to), begins = direction_at(next, next.from);
  return std::abs(std::atan2(cross(ends, begins), dot(ends, begins)));
}

double length_of(const Plan& plan) {
  double length = 0.0;
  for (const PathPiece& piece : plan.pieces) length += length_of(piece);
  for (std::size_t i = 1; plan.pieces.empty() && i < plan.waypoints.size(); ++i) {
    length += distance(plan.waypoints[i - 1], plan.waypoints[i]);
  }
  return length;
}

Plan plan_along(const Problem& problem, const std::vector<Cell>& vertices, double cost, double lower_bound,
                const PlanCounters& counters) {
  Plan plan;
  plan.vertices = vertices;
  keep_turns(plan.vertices);
  plan.waypoints.reserve(plan.vertices.size());
  for (const Cell vertex : plan.vertices) plan.waypoints.push_back(problem.grid->point(vertex));
  plan.cost = cost;
  plan.lower_bound = lower_bound;
  plan.reached_within = distance(plan.waypoints.back(), problem.goal);
  plan.counters = counters;
  return plan;
}

}  // namespace outrider
