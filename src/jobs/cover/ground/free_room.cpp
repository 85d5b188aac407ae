#include "ground/free_room.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

Box2 box_of(const PathPiece& piece) {
  Box2 box;
  if (piece.turn_rad == 0.0) {
    box.include(piece.from);
    box.include(piece.to);
  } else {  // of the whole circle
    const double radius = distance(piece.centre, piece.from);
    box.include(piece.centre - Vec2{radius, radius});
    box.include(piece.centre + Vec2{radius, radius});
  }
  return box;
}

/// Returns true if the arc passes that direction from its centre.
bool spans(const PathPiece& arc, Vec2 towards) {
  const double side = arc.turn_rad > 0.0 ? 1.0 : -1.0;
  const Vec2 arm = arc.from - arc.centre;
  const double angle = side * std::atan2(cross(arm, towards), dot(arm, towards));
  return (angle < 0.0 ? angle + 2.0 * pi : angle) <= std::abs(arc.turn_rad);
}

/// Returns true if the arc keeps that distance from the edge. It is nearest at an end of the arc or the edge,
/// at a crossing, or where a tangent is parallel to the edge.
bool arc_clear(const PathPiece& arc, const Segment& edge, double least_m) {
  if (distance(arc.from, edge) < least_m || distance(arc.to, edge) < least_m) return false;
  const double radius = distance(arc.centre, arc.from);
  for (const Vec2 corner : {edge.a, edge.b}) {
    const Vec2 arm = corner - arc.centre;
    if (std::abs(norm(arm) - radius) < least_m && spans(arc, arm)) return false;
  }
  const Vec2 along = (1.0 / distance(edge.a, edge.b)) * (edge.b - edge.a);
  const double foot = dot(arc.centre - edge.a, along), length = distance(edge.a, edge.b);
  const Vec2 to_line = edge.a + foot * along - arc.centre;
  const double away = norm(to_line);
  if (away >= radius) return away - radius >= least_m || foot < 0.0 || foot > length || !spans(arc, to_line);
  const double half = std::sqrt(radius * radius - away * away);
  for (const double at : {foot - half, foot + half}) {
    if (at >= 0.0 && at <= length && spans(arc, edge.a + at * along - arc.centre)) return false;
  }
  return true;
}

}  // namespace

FreeRoom::FreeRoom(const PolygonGround& ground) : ground_(ground) {
  for (const Segment& edge : ground.edges) {
    Box2 box;
    box.include(edge.a);
    box.include(edge.b);
    boxes_.push_back(box.grown(ground.radius_m));
  }
}

bool FreeRoom::free(const PathPiece& piece) const {
  const Box2 box = box_of(piece);
  const double radius = ground_.radius_m;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].overlaps(box)) continue;
    const Segment& edge = ground_.edges[i];
    const bool clear = piece.turn_rad == 0.0
                           ? distance(Segment{piece.from, piece.to}, edge) >= radius - contact_m
                           : arc_clear(piece, edge, radius - contact_m);
    if (!clear) return false;
  }
  return true;
}

bool FreeRoom::free(std::span<const PathPiece> pieces) const {
  return std::ranges::all_of(pieces, [this](const PathPiece& piece) { return free(piece); });
}

double FreeRoom::free_length(Vec2 from, double heading_rad, double most_m) const {
  const auto fits = [&](double length) {
    return free(PathPiece{from, from + length * direction(heading_rad), {}, 0.0});
  };
  if (fits(most_m)) return most_m;
  double low = 0.0, high = most_m;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace outrider::cover
