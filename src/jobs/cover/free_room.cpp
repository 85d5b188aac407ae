#include "free_room.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr double widest_chord_rad = 0.25 * pi;
constexpr double least_sagitta_m = 1e-10;

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

/// Returns true if the arc that begins at centre + arm keeps that distance from the edge.
bool arc_clear(Vec2 centre, Vec2 arm, double turn_rad, const Segment& edge, double radius_m) {
  const double sagitta = norm(arm) * (1.0 - std::cos(0.5 * turn_rad));
  const double away = distance(Segment{centre + arm, centre + rotated(turn_rad, arm)}, edge);
  if (away < radius_m - sagitta - contact_m) return false;
  if (std::abs(turn_rad) <= widest_chord_rad && away >= radius_m + sagitta - contact_m) return true;
  if (sagitta < least_sagitta_m) return away >= radius_m - contact_m;
  return arc_clear(centre, arm, 0.5 * turn_rad, edge, radius_m) &&
         arc_clear(centre, rotated(0.5 * turn_rad, arm), 0.5 * turn_rad, edge, radius_m);
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
                           : arc_clear(piece.centre, piece.from - piece.centre, piece.turn_rad, edge, radius);
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
