#include "polygon_ground_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/check.hpp"

namespace outrider {
namespace {

constexpr double slack_m = 2.0 * contact_m;

/// Returns true if the arc contains the direction v from its centre.
bool passes(const PathPiece& arc, Vec2 v) {
  const Vec2 begin = arc.from - arc.centre;
  double angle = std::atan2(cross(begin, v), dot(begin, v));
  if (arc.turn_rad > 0.0 && angle < 0.0) angle += 2.0 * pi;
  if (arc.turn_rad < 0.0 && angle > 0.0) angle -= 2.0 * pi;
  return std::abs(angle) <= std::abs(arc.turn_rad);
}

/// Returns the distance between an arc and an edge. It is attained at an end of one of them, at a crossing,
/// or along the normal of the edge.
double distance_to_arc(const PathPiece& arc, const Segment& edge) {
  double least = std::min(
      {distance(arc.from, edge), distance(arc.to, edge), distance_to(arc, edge.a), distance_to(arc, edge.b)});
  const Vec2 wall = edge.b - edge.a;
  const double part = dot(arc.centre - edge.a, wall) / squared_norm(wall);
  const Vec2 foot = edge.a + part * wall;
  const double radius = distance(arc.centre, arc.from), away = distance(arc.centre, foot);
  if (away <= radius) {
    const double half = std::sqrt(radius * radius - away * away) / norm(wall);
    for (const double at : {part - half, part + half}) {
      if (at >= 0.0 && at <= 1.0 && passes(arc, edge.a + at * wall - arc.centre)) return 0.0;
    }
  } else if (part >= 0.0 && part <= 1.0 && passes(arc, foot - arc.centre)) {
    least = std::min(least, away - radius);
  }
  return least;
}

double clearance(const PathPiece& piece, const PolygonGround& ground) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& edge : ground.edges) {
    least = std::min(least, distance_to(piece, edge));
  }
  return least;
}

/// Returns true if the polygon winds around p, by the sum of the angles that its edges span.
bool goes_round(const std::vector<Vec2>& polygon, Vec2 p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - p, b = polygon[(i + 1) % polygon.size()] - p;
    sum += std::atan2(cross(a, b), dot(a, b));
  }
  return std::abs(sum) > pi;
}

tl::unexpected<Fault> refused(std::string sentence) { return bad_input(std::move(sentence), "plan"); }

Status check_pieces(const Plan& plan, const Problem& problem) {
  const PolygonGround& ground = *problem.polygons;
  Vec2 at = problem.start;
  for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
    const PathPiece& piece = plan.pieces[i];
    const bool good_turn = std::abs(piece.turn_rad) < 2.0 * pi;
    const bool follows = distance(at, piece.from) <= slack_m;
    if (!good_turn || !follows) {
      return refused(fmt::format("piece {} does not begin where the one before ends", i));
    }
    const Vec2 end = piece.centre + rotated(piece.turn_rad, piece.from - piece.centre);
    if (piece.turn_rad != 0.0 && !(distance(end, piece.to) <= slack_m)) {
      return refused(fmt::format("piece {} is no arc from its begin to its end", i));
    }
    const double clear = clearance(piece, ground);
    if (!(clear >= ground.radius_m - slack_m)) {
      return refused(fmt::format("a disk of {} m comes within {} m of an edge on piece {}",
                                 short_number(ground.radius_m), short_number(clear), i));
    }
    at = piece.to;
  }
  if (!(distance(at, problem.goal) <= slack_m)) return refused("it does not end at the goal");
  return {};
}

Status check_waypoints(const Plan& plan, const Problem& problem) {
  const PolygonGround& ground = *problem.polygons;
  if (plan.waypoints.empty()) return refused("it has no waypoints");
  if (!(distance(plan.waypoints.front(), problem.start) <= slack_m)) {
    return refused("its waypoints do not begin at the start");
  }
  for (std::size_t i = 1; i < plan.waypoints.size(); ++i) {
    double apart = std::numeric_limits<double>::infinity();
    for (const PathPiece& piece : plan.pieces) apart = std::min(apart, distance_to(piece, plan.waypoints[i]));
    const double clear = clearance({plan.waypoints[i - 1], plan.waypoints[i], {}, 0.0}, ground);
    const bool good = apart <= plan.waypoint_error_m + slack_m &&
                      clear >= ground.radius_m - plan.waypoint_error_m - slack_m;
    if (!good) {
      return refused(
          fmt::format("waypoint {} lies {} m from the path and {} m from an edge, which its "
                      "error of {} m does not allow",
                      i, short_number(apart), short_number(clear), short_number(plan.waypoint_error_m)));
    }
  }
  return {};
}

}  // namespace

double distance_to(const PathPiece& piece, Vec2 p) {
  if (piece.turn_rad == 0.0) return distance(p, Segment{piece.from, piece.to});
  const double ends = std::min(distance(p, piece.from), distance(p, piece.to));
  if (!passes(piece, p - piece.centre)) return ends;
  return std::min(ends, std::abs(distance(p, piece.centre) - distance(piece.centre, piece.from)));
}

double distance_to(const PathPiece& piece, const Segment& edge) {
  return piece.turn_rad == 0.0 ? distance(Segment{piece.from, piece.to}, edge) : distance_to_arc(piece, edge);
}

double clearance_m(const Plan& plan, const PolygonGround& ground) {
  double least = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : plan.pieces) least = std::min(least, clearance(piece, ground));
  for (std::size_t i = 0; plan.pieces.empty() && i < plan.waypoints.size(); ++i) {
    const Vec2 before = plan.waypoints[i == 0 ? 0 : i - 1];
    least = std::min(least, clearance({before, plan.waypoints[i], {}, 0.0}, ground));
  }
  return least;
}

Status check_on_polygons(const Plan& plan, const Problem& problem) {
  const PolygonGround& ground = *problem.polygons;
  bool inside = !goes_round(ground.boundary, problem.start);
  for (const auto& obstacle : ground.obstacles) inside = inside || goes_round(obstacle, problem.start);
  if (inside) return refused("it begins in an obstacle");
  if (auto good = check_pieces(plan, problem); !good) return good;
  return check_waypoints(plan, problem);
}

}  // namespace outrider
