#include "strokes/headland.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr double least_leg_m = 1e-6;  // shorter ones have no heading to speak of
constexpr double least_kite =
    0.02;  // of the radius of the disk: how far a corner is from the arc that rounds it
constexpr double most_corner = 4.0;  // turning radii, that the robot goes on into a corner
constexpr double same_radius = 1e-6;

/// The piece of a lap, with the solid on its left, moved towards the solid.
PathPiece moved_out(const PathPiece& piece, double by_m) {
  if (piece.turn_rad == 0.0) {
    const Vec2 aside = by_m * perpendicular(direction(heading_in(piece)));
    return {piece.from + aside, piece.to + aside, {}, 0.0};
  }
  const double radius = distance(piece.centre, piece.from), scale = (radius - by_m) / radius;
  const auto at = [&](Vec2 p) { return piece.centre + scale * (p - piece.centre); };
  return {at(piece.from), at(piece.to), piece.centre, piece.turn_rad};
}

/// The lap moved towards the solid, with arcs of that radius about its corners.
Lap opened(const Lap& lap, double radius_m) {
  Lap result;
  const auto add = [&](const PathPiece& piece) {
    if (length_of(piece) > least_leg_m || piece.turn_rad != 0.0) result.push_back(piece);
  };
  for (std::size_t i = 0; i < lap.size(); ++i) {
    const PathPiece &piece = lap[i], &next = lap[(i + 1) % lap.size()];
    const PathPiece out = moved_out(piece, radius_m);
    add(out);
    const double turn = wrap_angle(heading_in(next) - heading_out(piece));
    if (std::abs(turn) <= no_turn_rad) continue;
    // The solid is on the left, so the corners of the smaller room turn right.
    const PathPiece after = moved_out(next, radius_m);
    add({out.to, after.from, next.from, turn > 0.0 ? turn - 2.0 * pi : turn});
  }
  return result;
}

PathPiece leg(Vec2 from, double heading_rad, double length_m, bool backward = false) {
  return {from, from + (backward ? -length_m : length_m) * direction(heading_rad), {}, 0.0, backward};
}

/// Goes straight on and comes back; nothing where there is no room.
void add_excursion(Lap& lap, const FreeRoom& room, Vec2 at, double heading_rad, bool backward,
                   double most_m) {
  const double away = backward ? heading_rad + pi : heading_rad;
  const double length = room.free_length(at, away, most_m);
  if (length <= least_leg_m) return;
  const PathPiece out = leg(at, heading_rad, length, backward);
  lap.push_back(out);
  lap.push_back({out.to, at, {}, 0.0, !backward});
}

/// The lap with excursions into the corners that its arcs round.
Lap into_corners(const Lap& lap, double turning_radius_m, double least_m, const FreeRoom& room) {
  Lap result;
  for (const PathPiece& piece : lap) {
    const double radius = distance(piece.centre, piece.from), half = 0.5 * std::abs(piece.turn_rad);
    const bool rounds = piece.turn_rad < 0.0 && std::abs(radius - turning_radius_m) <= same_radius * radius;
    const double kite = half < 0.5 * pi ? radius * (1.0 / std::cos(half) - 1.0) : most_corner * radius;
    if (!rounds || kite <= least_m) {
      result.push_back(piece);
      continue;
    }
    const double most =
        half < 0.5 * pi ? std::min(std::tan(half), most_corner) * radius : most_corner * radius;
    add_excursion(result, room, piece.from, heading_in(piece), false, most);
    result.push_back(piece);
    add_excursion(result, room, piece.to, heading_out(piece), true, most);
  }
  return result;
}

/// The parts of the lap between its arcs that are too tight, gone on beside them.
std::vector<Stroke> cut_at_tight_arcs(const Lap& lap, double turning_radius_m, const FreeRoom& room) {
  const auto tight = [&](const PathPiece& piece) {
    return piece.turn_rad > 0.0 &&
           distance(piece.centre, piece.from) < turning_radius_m * (1.0 - same_radius);
  };
  const auto first = std::find_if(lap.begin(), lap.end(), tight);
  if (first == lap.end()) return {{lap, PieceRole::lap, true}};
  const Lap begun = begun_at(lap, static_cast<std::size_t>(first - lap.begin()));
  const auto beyond = [](const PathPiece& arc) {
    const double radius = distance(arc.centre, arc.from), half = 0.5 * arc.turn_rad;
    return radius * (half < 0.5 * pi ? std::min(2.0, std::tan(half)) : 2.0);
  };
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < begun.size(); ++i) {
    const PathPiece& arc = begun[i];
    if (!tight(arc)) continue;
    Stroke stroke;
    std::size_t end = i + 1;
    for (; end < begun.size() && !tight(begun[end]); ++end) stroke.pieces.push_back(begun[end]);
    if (stroke.pieces.empty()) continue;
    const PathPiece& next = begun[end % begun.size()];
    const double before = room.free_length(arc.to, heading_out(arc) + pi, beyond(arc));
    const double after = room.free_length(next.from, heading_in(next), beyond(next));
    if (before > least_leg_m) {
      const Vec2 from = arc.to - before * direction(heading_out(arc));
      stroke.pieces.insert(stroke.pieces.begin(), {from, arc.to, {}, 0.0});
    }
    if (after > least_leg_m) stroke.pieces.push_back(leg(next.from, heading_in(next), after));
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

/// Makes ends that are one point but for rounding the same.
void snap(Lap& lap) {
  for (std::size_t i = 0; i < lap.size(); ++i) {
    PathPiece& next = lap[(i + 1) % lap.size()];
    if (next.turn_rad == 0.0) {
      next.from = lap[i].to;
    } else {
      lap[i].to = next.from;
    }
  }
}

}  // namespace

Outcome<std::vector<Stroke>> headland_lap(const CoverProblem& problem, const CoverField& field, int number,
                                          double arc_m, const FreeRoom& room) {
  const double turning = problem.turning_radius_m;
  const double smaller = problem.radius_m() + number * problem.stride_m() + turning;
  std::vector<Stroke> strokes;
  if (smaller > most_polygon_radius_m) return strokes;
  auto inner = PolygonGround::of(field.ground->boundary, field.ground->obstacles, smaller);
  if (!inner) return pass_on(inner);
  for (const Lap& lap : laps_within(*inner, field.standing, arc_m)) {
    Lap round = opened(lap, turning);
    snap(round);
    if (!room.free(round)) continue;  // of rooms so small that their laps are rounding
    if (problem.reverse) round = into_corners(round, turning, least_kite * problem.radius_m(), room);
    for (Stroke& stroke : cut_at_tight_arcs(round, turning, room)) strokes.push_back(std::move(stroke));
  }
  return strokes;
}

}  // namespace outrider::cover
