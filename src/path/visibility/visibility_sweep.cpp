#include <algorithm>
#include <cmath>

#include "visibility_tangents.hpp"

namespace outrider {
namespace {

constexpr double margin_turn = 1e-7;   // blocking this near the end of a piece is left to the exact test
constexpr double margin_ratio = 1e-6;  // and so is a piece this near the end of the leg
constexpr double beside_m = 1e-6;      // pieces this near a point hide nothing that is told by headings
constexpr double no_span = 1e-12;
constexpr double full_turn = 4.0;

/// Returns a number from -2 to 2 that increases with the angle from one unit vector to another; 1 is a right
/// angle.
double turn_between(Vec2 from, Vec2 to) {
  const double x = dot(from, to), y = cross(from, to);
  const double part = y / (std::abs(x) + std::abs(y));
  if (x >= 0.0) return part;
  return y >= 0.0 ? 2.0 - part : -2.0 - part;
}

/// A part of the border of free space, and the candidates that it may hide.
struct Piece {
  Segment wall;
  std::size_t first = 0;
  std::size_t end = 0;
};

/// A leg that is tangent to both its arcs, free or not.
struct Candidate {
  double turned = 0.0;
  Node to = 0;
  Tangent leg;
};

/// A rotating ray tangent to a place, parametrised by its rotation to the left from its first heading. Only
/// the directions of candidates matter, so a piece of a wall that hides none of them is skipped at once.
struct Sweep {
  const PolygonGround& ground;
  Place place;
  Vec2 first{1.0, 0.0};
  Vec2 last{1.0, 0.0};
  std::vector<Candidate> legs{};  ///< by turn
  std::vector<Piece> pieces{};

  Sweep(const PolygonGround& on, const Place& round) : ground(on), place(round) {
    if (place.arc == nullptr) return;
    first = place.side * perpendicular(place.arc->first);
    last = place.side * perpendicular(place.arc->last);
  }
  [[nodiscard]] bool all_round() const { return place.arc == nullptr; }

  [[nodiscard]] double turned(Vec2 along) const {
    const double turn = turn_between(first, along);
    return all_round() && turn < 0.0 ? turn + full_turn : turn;
  }
  /// Returns the direction in which the ray meets a point outside the circle of the place.
  [[nodiscard]] Vec2 towards(Vec2 p) const {
    const Vec2 v = p - place.centre;
    const double aside = place.side * place.radius_m;
    const double apart = squared_norm(v);
    if (apart <= aside * aside) return (1.0 / norm(v)) * (place.side * perpendicular(v));
    return (1.0 / apart) * (std::sqrt(apart - aside * aside) * v + aside * perpendicular(v));
  }
  /// Returns the distance along a leg at which it meets the line of the piece.
  [[nodiscard]] double met_at(const Piece& piece, const Tangent& leg) const {
    const Vec2 wall = piece.wall.b - piece.wall.a;
    const double slope = cross(leg.along, wall);
    return slope == 0.0 ? 0.0 : cross(piece.wall.a - leg.from, wall) / slope;
  }
  /// Returns true if the ray meets nothing within `reach` of the two points.
  [[nodiscard]] bool passes_by(Vec2 a, Vec2 b, double reach) const {
    if (all_round()) return false;
    const double most = place.radius_m + reach;
    const Vec2 u = a - place.centre, v = b - place.centre;
    const bool right = std::max(cross(first, u), cross(first, v)) < -most;
    const bool left = std::min(cross(last, u), cross(last, v)) > most;
    return right | left;
  }
  /// Finds the candidates to nodes not below `least`.
  void find_candidates(Node least);
  /// Limits the rotation to the range of the candidates; pieces outside of it hide none.
  void narrow() {
    if (all_round()) return;
    first = legs.front().leg.along;
    last = legs.back().leg.along;
    for (Candidate& leg : legs) leg.turned = turned(leg.leg.along);
  }

  /// Adds a piece that the ray meets from one direction to another, less than half a turn apart.
  void add(Vec2 from, Vec2 to, const Segment& wall) {
    if (cross(from, to) <= no_span) return;
    const double low = turned(from);
    double high = turned(to);
    if (high < low) high += full_turn;
    const auto take = [&](double begin, double end) {
      const auto before = [](const Candidate& leg, double at) { return leg.turned < at; };
      const auto one = std::lower_bound(legs.begin(), legs.end(), begin + margin_turn, before);
      const auto other = std::lower_bound(one, legs.end(), end - margin_turn, before);
      if (one != other) {
        pieces.push_back({wall, static_cast<std::size_t>(one - legs.begin()),
                          static_cast<std::size_t>(other - legs.begin())});
      }
    };
    take(low, high);
    if (all_round() && high > full_turn) take(low - full_turn, high - full_turn);
  }
  void add_wall(const Segment& wall) {
    if (passes_by(wall.a, wall.b, 0.0)) return;
    // Solid lies to the left of a wall: the ray meets it from outside when it crosses to the left.
    const Vec2 along = wall.b - wall.a;
    if (!all_round() && cross(along, first) <= 0.0 && cross(along, last) <= 0.0) return;
    if (all_round() && distance(place.centre, wall) < beside_m) return;
    const double left = cross(along, place.centre - wall.a);
    const bool cuts_circle = left * left < squared_norm(along) * place.radius_m * place.radius_m;
    if (!cuts_circle && left > 0.0) return;
    if (cuts_circle && cross(along, towards(0.5 * (wall.a + wall.b))) <= 0.0) return;
    const Vec2 a = towards(wall.a), b = towards(wall.b);
    const bool swapped = cross(a, b) < 0.0;
    add(swapped ? b : a, swapped ? a : b, wall);
  }
  void gather() {
    for (const Segment& wall : ground.walls) add_wall(wall);
    const double r = ground.radius_m;
    for (const FreeArc& arc : ground.arcs) {
      if (&arc == place.arc || passes_by(arc.centre, arc.centre, r)) continue;
      // The chord of an arc hides less than it, and what is left over is tested.
      add_wall({arc.centre + r * arc.first, arc.centre + r * arc.last});
    }
  }
};

void Sweep::find_candidates(Node least) {
  const double reach = 1.001 * ground.radius_m;
  for (std::size_t i = least / 2; i < ground.arcs.size(); ++i) {
    const Vec2 centre = ground.arcs[i].centre;
    if (passes_by(centre, centre, reach)) continue;
    for (const Node to : {static_cast<Node>(2 * i), static_cast<Node>(2 * i + 1)}) {
      const Sweep back(ground, place_of(ground, turned_round(to)));  // the way back reaches the place too
      if (back.passes_by(place.centre, place.centre, reach)) continue;
      const Place other = place_of(ground, to);
      const auto leg = tangent(place, other);
      if (!leg || !touches_arc(place, leg->along) || !touches_arc(other, leg->along)) continue;
      legs.push_back({turned(leg->along), to, *leg});
    }
  }
  std::sort(legs.begin(), legs.end(), [](const Candidate& a, const Candidate& b) {
    return a.turned != b.turned ? a.turned < b.turned : a.to < b.to;
  });
}

/// The pieces that the ray meets at present, nearest first, while it rotates from candidate to candidate.
/// They are few, and pieces do not cross, so their order is the same along all rays.
struct MetPieces {
  Sweep& sweep;
  std::vector<Piece> order{};
  std::size_t next = 0;

  explicit MetPieces(Sweep& of) : sweep(of) {
    std::sort(sweep.pieces.begin(), sweep.pieces.end(),
              [](const Piece& a, const Piece& b) { return a.first < b.first; });
  }
  void turn_to(std::size_t candidate) {
    std::erase_if(order, [=](const Piece& piece) { return piece.end <= candidate; });
    const Tangent& leg = sweep.legs[candidate].leg;
    for (; next < sweep.pieces.size() && sweep.pieces[next].first == candidate; ++next) {
      const Piece& piece = sweep.pieces[next];
      const double at = sweep.met_at(piece, leg);
      const auto nearer = [&](const Piece& other, double than) { return sweep.met_at(other, leg) < than; };
      order.insert(std::lower_bound(order.begin(), order.end(), at, nearer), piece);
    }
  }
  /// Returns true if the nearest piece clearly crosses the leg.
  [[nodiscard]] bool hide(const Tangent& leg) const {
    return !order.empty() &&
           sweep.met_at(order.front(), leg) < leg.length - margin_ratio * (1.0 + leg.length);
  }
};

}  // namespace

void departures_swept(const PolygonGround& ground, const Place& place, Node least,
                      std::vector<Departure>& found, std::uint64_t& tests) {
  Sweep sweep(ground, place);
  sweep.find_candidates(least);
  if (sweep.legs.empty()) return;
  sweep.narrow();
  sweep.gather();
  MetPieces met(sweep);
  for (std::size_t i = 0; i < sweep.legs.size(); ++i) {
    met.turn_to(i);
    const auto& [turned, to, leg] = sweep.legs[i];
    if (met.hide(leg)) continue;
    ++tests;
    if (!ground.segment_free({leg.from, leg.to})) continue;
    const Place other = place_of(ground, to);
    found.push_back({to, progress(place, leg.along), progress(other, leg.along), leg.length, leg.to});
  }
  std::sort(found.begin(), found.end(), [](const Departure& a, const Departure& b) { return a.to < b.to; });
}

}  // namespace outrider
