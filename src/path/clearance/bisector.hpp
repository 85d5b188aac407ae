// A bisector: a piece of a medial axis, the points at equal distance from two features (corners or edges).
//
// Two corners or two edges make a straight piece, a corner and an edge a part of a parabola. A point on the
// piece has the coordinate u: along the straight line, or along the edge for a parabola. Clearance, length
// and exposure (the integral of 1 / clearance) are closed forms:
//   two edges          c = c0 + k u              exposure ln(c1 / c0) / k
//   two corners        c = sqrt(h^2 + u^2)       exposure asinh(u1 / h) - asinh(u0 / h)
//   corner and edge    c = (u^2 + d^2) / (2 d)   exposure 2 asinh(u1 / d) - 2 asinh(u0 / d)
// Here 2 h is the distance between the corners and u starts at their midpoint; d is the distance from the
// corner to the line of the edge, and u starts at the foot of the corner on it. Lengths are in m.
#pragma once

#include "outrider/geometry/convex.hpp"

namespace outrider {

/// A feature of the ground: an edge without its ends, or a corner (a == b).
struct Feature {
  Vec2 a;
  Vec2 b;

  [[nodiscard]] bool is_corner() const { return a == b; }
};

struct Bisector {
  enum class Kind { edges, corners, parabola };

  Kind kind = Kind::edges;
  Vec2 origin;         ///< point with u = 0: on the line, or on the edge below the corner
  Vec2 along;          ///< unit vector of growing u
  Vec2 across;         ///< parabola: from the edge towards the corner
  double apart = 0.0;  ///< h or d; c0 for two edges
  double slope = 0.0;  ///< k for two edges
  double u0 = 0.0;
  double u1 = 0.0;

  /// Returns the piece between two points that are equally far from both features.
  static Bisector between(const Feature& one, const Feature& other, Vec2 from, Vec2 to);

  [[nodiscard]] Vec2 at(double u) const;
  [[nodiscard]] double clearance(double u) const;
  /// Returns the least clearance between u0 and u1.
  [[nodiscard]] double least_clearance() const;
  /// Returns the length between u0 and u1.
  [[nodiscard]] double length() const;
  [[nodiscard]] double exposure() const;
  /// Returns the u between u0 and u1 of a point on or near the piece.
  [[nodiscard]] double u_of(Vec2 p) const;
  /// Returns the part between two values of u, in either direction.
  [[nodiscard]] Bisector part(double from, double to) const;
};

}  // namespace outrider
