#include "visibility_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace outrider {
namespace {

constexpr int most_halvings = 6;
constexpr double no_length_m = 1e-12;

std::vector<PathPiece> exact_pieces(const Problem& problem, const std::vector<WayLeg>& way) {
  const PolygonGround& ground = *problem.polygons;
  std::vector<PathPiece> pieces;
  Vec2 at = problem.start;
  const auto go = [&](const PathPiece& piece) {
    if (length_of(piece) > no_length_m) pieces.push_back(piece);
    if (!pieces.empty()) pieces.back().to = at = piece.to;
  };
  for (std::size_t i = 0; i < way.size(); ++i) {
    const WayLeg& leg = way[i];
    if (i > 0) {
      const Place place = place_of(ground, leg.round);
      const double turn = place.side * std::max(0.0, leg.left - leg.entered);
      if (turn != 0.0) go({at, point_at(place, leg.left), place.centre, turn});
    }
    go({at, leg.to, {}, 0.0});
  }
  return pieces;
}

/// Returns the corners of the tangents that replace an arc, in `parts` equal parts.
std::vector<Vec2> tangent_corners(const PathPiece& arc, int parts) {
  const Vec2 out = arc.from - arc.centre;
  const double step = arc.turn_rad / parts;
  std::vector<Vec2> corners;
  for (int i = 0; i < parts; ++i) {
    const Vec2 turned = direction((i + 0.5) * step);
    const Vec2 ray = turned.x * out + turned.y * perpendicular(out);
    corners.push_back(arc.centre + (1.0 / std::cos(0.5 * step)) * ray);
  }
  return corners;
}

int parts_of(const PathPiece& arc, double step) {
  return std::max(1, static_cast<int>(std::ceil(std::abs(arc.turn_rad) / step - 1e-9)));
}

/// Returns the arc as collision-free straight pieces, or nothing.
std::optional<std::vector<PathPiece>> straightened(const PolygonGround& ground, const PathPiece& arc,
                                                   double step) {
  for (int halving = 0, parts = parts_of(arc, step); halving <= most_halvings; ++halving, parts *= 2) {
    std::vector<PathPiece> legs;
    Vec2 at = arc.from;
    bool free = true;
    std::vector<Vec2> corners = tangent_corners(arc, parts);
    corners.push_back(arc.to);
    for (const Vec2 corner : corners) {
      free = free && ground.segment_free({at, corner});
      legs.push_back({at, corner, {}, 0.0});
      at = corner;
    }
    if (free) return legs;
  }
  return std::nullopt;
}

void add_waypoints(Plan& plan, const PathPiece& piece, double step) {
  if (piece.turn_rad == 0.0) return;
  const int parts = parts_of(piece, step);
  for (const Vec2 corner : tangent_corners(piece, parts)) plan.waypoints.push_back(corner);
  const double stretch = 1.0 / std::cos(0.5 * std::abs(piece.turn_rad) / parts) - 1.0;
  plan.waypoint_error_m = std::max(plan.waypoint_error_m, stretch * distance(piece.centre, piece.from));
}

/// Returns the total turning. The path turns only on its arcs, because its legs are tangents; straight legs
/// in place of an arc turn by the same angle.
double turning_along(const std::vector<PathPiece>& pieces, const CostWeights& weights) {
  double turning = 0.0;
  for (const PathPiece& piece : pieces) turning += std::abs(piece.turn_rad);
  if (!weights.heading_rad || pieces.empty()) return turning;
  const Vec2 faced = direction(*weights.heading_rad);
  return turning + turn_between({-1.0 * faced, {}, {}, 0.0}, pieces.front());
}

}  // namespace

Plan plan_of(const Problem& problem, const std::vector<WayLeg>& way, const CostWeights& weights,
             const VisibilityOptions& options, const PlanCounters& counters) {
  Plan plan;
  plan.counters = counters;
  plan.weights = weights;
  plan.waypoints.push_back(problem.start);
  const std::vector<PathPiece> exact = exact_pieces(problem, way);
  const double turning = weights.per_rad == 0.0 ? 0.0 : weights.per_rad * turning_along(exact, weights);
  plan.cost = plan.lower_bound = turning;
  for (const PathPiece& piece : exact) {
    plan.lower_bound += weights.per_m * length_of(piece);
    if (options.polygonal && piece.turn_rad != 0.0) {
      if (auto legs = straightened(*problem.polygons, piece, options.arc_step_rad)) {
        plan.pieces.insert(plan.pieces.end(), legs->begin(), legs->end());
        continue;
      }
    }
    plan.pieces.push_back(piece);
  }
  for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
    const PathPiece& piece = plan.pieces[i];
    plan.cost += weights.per_m * length_of(piece);
    add_waypoints(plan, piece, options.arc_step_rad);
    const bool bends =
        i + 1 < plan.pieces.size() && piece.turn_rad == 0.0 && plan.pieces[i + 1].turn_rad == 0.0;
    if (bends || i + 1 == plan.pieces.size()) plan.waypoints.push_back(piece.to);
  }
  plan.reached_within = distance(plan.waypoints.back(), problem.goal);
  return plan;
}

}  // namespace outrider
