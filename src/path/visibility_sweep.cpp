#include <algorithm>
#include <cmath>
#include <set>

#include "visibility_tangents.hpp"

namespace outrider {
namespace {

constexpr double margin_turn = 1e-7;   // blocking this near the end of a piece is left to the exact test
constexpr double margin_ratio = 1e-6;  // and so is what lies this near the end of the leg
constexpr double beside_m = 1e-6;      // pieces this near a point hide nothing that is told by headings
constexpr double no_span = 1e-12;
constexpr double full_turn = 4.0;

Vec2 right_of(Vec2 v) { return {v.y, -v.x}; }

/// A measure of the angle from one unit vector to another, -2 to 2, which grows with it: 1 is a right angle.
double turn_between(Vec2 from, Vec2 to) {
  const double x = dot(from, to), y = cross(from, to);
  const double part = y / (std::abs(x) + std::abs(y));
  if (x >= 0.0) return part;
  return y >= 0.0 ? 2.0 - part : -2.0 - part;
}

/// A piece of the bounds of free space as the turning ray meets it from outside.
struct Piece {
  double low = 0.0;  ///< turned from the sweep's first heading
  double high = 0.0;
  Vec2 towards_low;  ///< unit vectors of both
  Vec2 towards_high;
  Vec2 a;  ///< of a wall; centre of an arc
  Vec2 b;
  bool is_arc = false;
};

/// A ray tangent to a place, by how far it is turned from its first heading to the left.
struct Sweep {
  const PolygonGround& ground;
  Place place;
  Vec2 first{1.0, 0.0};
  Vec2 last{1.0, 0.0};
  double width = full_turn;
  std::vector<Piece> pieces{};

  Sweep(const PolygonGround& on, const Place& round) : ground(on), place(round) {
    if (place.arc == nullptr) return;
    first = place.side * perpendicular(place.arc->first);
    last = place.side * perpendicular(place.arc->last);
    width = turn_between(first, last);
  }
  [[nodiscard]] bool all_round() const { return place.arc == nullptr; }

  [[nodiscard]] double turned(Vec2 along) const {
    const double turn = turn_between(first, along);
    return all_round() && turn < 0.0 ? turn + full_turn : turn;
  }
  /// The direction in which the ray meets a point outside the circle of the place.
  [[nodiscard]] Vec2 towards(Vec2 p) const {
    const Vec2 v = p - place.centre;
    const double aside = place.side * place.radius_m;
    const double apart = squared_norm(v);
    if (apart <= aside * aside) return (1.0 / norm(v)) * (place.side * perpendicular(v));
    return (1.0 / apart) * (std::sqrt(apart - aside * aside) * v + aside * perpendicular(v));
  }
  /// How far along a ray in that direction the piece is met.
  [[nodiscard]] double met_at(const Piece& piece, Vec2 along) const {
    const Vec2 from = place.centre + place.radius_m * place.side * right_of(along);
    if (!piece.is_arc) {
      const Vec2 wall = piece.b - piece.a;
      const double slope = cross(along, wall);
      return slope == 0.0 ? 0.0 : cross(piece.a - from, wall) / slope;
    }
    const double h = cross(along, piece.a - from);
    const double half = std::sqrt(std::max(0.0, ground.radius_m * ground.radius_m - h * h));
    return dot(along, piece.a - from) - half;
  }
  /// Whether the ray meets none of what lies within `reach` of the two points.
  [[nodiscard]] bool passes_by(Vec2 a, Vec2 b, double reach) const {
    if (all_round()) return false;
    const double most = place.radius_m + reach;
    const Vec2 u = a - place.centre, v = b - place.centre;
    return (cross(first, u) < -most && cross(first, v) < -most) ||
           (cross(last, u) > most && cross(last, v) > most);
  }

  /// Takes in a piece that the ray meets from one direction to another, less than half a turn apart.
  void add(Vec2 from, Vec2 to, Piece piece) {
    if (cross(from, to) <= no_span) return;
    const double low = turned(from);
    double high = turned(to);
    if (high < low) high += full_turn;
    const auto keep = [&](double begin, double end) {
      piece.low = std::max(begin, 0.0);
      piece.high = std::min(end, width);
      piece.towards_low = begin < 0.0 ? first : from;
      piece.towards_high = end > width ? last : to;
      if (piece.high - piece.low > no_span) pieces.push_back(piece);
    };
    keep(low, high);
    if (all_round() && high > full_turn) keep(low - full_turn, high - full_turn);
  }
  void add_wall(const Segment& wall) {
    const Vec2 along = wall.b - wall.a;
    // Solid lies to the left of a wall: the ray meets it from outside when it crosses to the left.
    if (!all_round() && cross(along, first) <= 0.0 && cross(along, last) <= 0.0) return;
    if (passes_by(wall.a, wall.b, 0.0)) return;
    if (all_round() && distance(place.centre, wall) < beside_m) return;
    const double left = cross(along, place.centre - wall.a);
    const bool cuts_circle = left * left < squared_norm(along) * place.radius_m * place.radius_m;
    if (!cuts_circle && left > 0.0) return;
    if (cuts_circle && cross(along, towards(0.5 * (wall.a + wall.b))) <= 0.0) return;
    const Vec2 a = towards(wall.a), b = towards(wall.b);
    const bool swapped = cross(a, b) < 0.0;
    add(swapped ? b : a, swapped ? a : b, {0.0, 0.0, {}, {}, wall.a, wall.b, false});
  }
  void add_arc(const FreeArc& arc);
  void gather() {
    for (const Segment& wall : ground.walls) add_wall(wall);
    for (const FreeArc& arc : ground.arcs) {
      if (&arc != place.arc) add_arc(arc);
    }
  }
};

/// Whether v lies from one unit vector counter-clockwise to another, less than half a turn apart.
bool lies_between(Vec2 v, Vec2 from, Vec2 to) { return cross(from, v) >= 0.0 && cross(v, to) >= 0.0; }

/// The part of an arc that faces the ray: between the points where the ray only touches its circle.
void Sweep::add_arc(const FreeArc& arc) {
  if (passes_by(arc.centre, arc.centre, ground.radius_m)) return;
  const double beside = std::abs(distance(place.centre, arc.centre) - ground.radius_m);
  if (all_round() && beside < beside_m) return;
  const auto touch = [&](double side) {
    return tangent(place, {arc.centre, ground.radius_m, side, nullptr});
  };
  const auto left = touch(1.0), right = touch(-1.0);  // the centre to the left or to the right of the ray
  if (!left && !right) return;
  const Vec2 apart = place.centre - arc.centre;
  const Vec2 back = (1.0 / norm(apart)) * apart;
  // Seen from the centre of the arc, what faces the ray begins and ends here.
  const Vec2 begin = right ? perpendicular(right->along) : back;
  const Vec2 end = left ? right_of(left->along) : back;
  if (cross(begin, end) <= 0.0) return;
  const bool begins_within = lies_between(arc.first, begin, end);
  if (!begins_within && !lies_between(begin, arc.first, arc.last)) return;
  const Vec2 low = begins_within ? arc.first : begin;
  const Vec2 high = lies_between(arc.last, begin, end) ? arc.last : end;
  if (cross(low, high) <= no_span) return;
  add(towards(arc.centre + ground.radius_m * high), towards(arc.centre + ground.radius_m * low),
      {0.0, 0.0, {}, {}, arc.centre, arc.centre, true});
}

/// Nearest first. Pieces do not cross, so one direction in which both are met tells.
struct Nearer {
  const Sweep* sweep;
  bool operator()(std::uint32_t i, std::uint32_t j) const {
    if (i == j) return false;
    const Piece &p = sweep->pieces[i], &q = sweep->pieces[j];
    const Vec2 sum = (p.low > q.low ? p : q).towards_low + (p.high < q.high ? p : q).towards_high;
    const double length = norm(sum);
    if (length < 1e-6) return i < j;
    const Vec2 shared = (1.0 / length) * sum;
    const double a = sweep->met_at(p, shared), b = sweep->met_at(q, shared);
    return a != b ? a < b : i < j;
  }
};

struct Candidate {
  double turned = 0.0;
  Node to = 0;
  Tangent leg;
};

std::vector<Candidate> candidates(const Sweep& sweep) {
  std::vector<Candidate> found;
  const auto nodes = static_cast<Node>(2 * sweep.ground.arcs.size());
  for (Node to = 0; to < nodes; ++to) {
    const Place other = place_of(sweep.ground, to);
    if (sweep.passes_by(other.centre, other.centre, 1.001 * other.radius_m)) continue;
    const auto leg = tangent(sweep.place, other);
    if (!leg || !touches_arc(sweep.place, leg->along) || !touches_arc(other, leg->along)) continue;
    found.push_back({sweep.turned(leg->along), to, *leg});
  }
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.turned != b.turned ? a.turned < b.turned : a.to < b.to;
  });
  return found;
}

/// Whether the nearest piece plainly crosses the leg.
bool hidden(const Sweep& sweep, const Piece& piece, const Candidate& leg) {
  const double at = leg.turned;
  if (at < piece.low + margin_turn || at > piece.high - margin_turn) return false;
  return sweep.met_at(piece, leg.leg.along) < leg.leg.length - margin_ratio * (1.0 + leg.leg.length);
}

/// The pieces that the ray meets now, as it turns.
struct MetPieces {
  using Order = std::set<std::uint32_t, Nearer>;

  const std::vector<Piece>& pieces;
  Order order;
  std::vector<std::uint32_t> entering;  ///< by the turn at which they are met first
  std::vector<std::uint32_t> leaving;   ///< and last
  std::vector<Order::iterator> where;
  std::size_t in = 0;
  std::size_t out = 0;

  explicit MetPieces(const Sweep& sweep) : pieces(sweep.pieces), order(Nearer{&sweep}) {
    for (std::uint32_t i = 0; i < pieces.size(); ++i) entering.push_back(i);
    leaving = entering;
    where.assign(pieces.size(), order.end());
    const auto sort_by = [this](std::vector<std::uint32_t>& list, double Piece::* end) {
      std::sort(list.begin(), list.end(), [this, end](std::uint32_t i, std::uint32_t j) {
        return pieces[i].*end != pieces[j].*end ? pieces[i].*end < pieces[j].*end : i < j;
      });
    };
    sort_by(entering, &Piece::low);
    sort_by(leaving, &Piece::high);
  }
  void leave_until(double turned) {
    for (; out < leaving.size() && pieces[leaving[out]].high <= turned; ++out) {
      if (where[leaving[out]] != order.end()) order.erase(where[leaving[out]]);
    }
  }
  void turn_to(double turned) {
    for (; in < entering.size() && pieces[entering[in]].low < turned; ++in) {
      leave_until(pieces[entering[in]].low);
      where[entering[in]] = order.insert(entering[in]).first;
    }
    leave_until(turned);
  }
};

}  // namespace

void departures_swept(const PolygonGround& ground, const Place& place, std::vector<Departure>& found,
                      std::uint64_t& tests) {
  Sweep sweep(ground, place);
  const std::vector<Candidate> legs = candidates(sweep);
  if (legs.empty()) return;
  sweep.gather();
  MetPieces met(sweep);
  for (const Candidate& leg : legs) {
    met.turn_to(leg.turned);
    if (!met.order.empty() && hidden(sweep, sweep.pieces[*met.order.begin()], leg)) continue;
    ++tests;
    if (!ground.segment_free({leg.leg.from, leg.leg.to})) continue;
    const Place other = place_of(ground, leg.to);
    found.push_back(
        {leg.to, progress(place, leg.leg.along), progress(other, leg.leg.along), leg.leg.length, leg.leg.to});
  }
  std::sort(found.begin(), found.end(), [](const Departure& a, const Departure& b) { return a.to < b.to; });
}

}  // namespace outrider
