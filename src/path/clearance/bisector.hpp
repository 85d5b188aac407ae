// A piece of a medial axis: the points as far from one feature (a corner or an edge) as from another.
//
// Two corners or two edges make a straight piece, a corner and an edge part of a parabola. Points on it are
// counted by u: along the straight line, or along the edge for a parabola. Clearance, length and exposure
// (the integral of 1 / clearance) are closed forms:
//   two edges          c = c0 + k u              exposure ln(c1 / c0) / k
//   two corners        c = sqrt(h^2 + u^2)       exposure asinh(u1 / h) - asinh(u0 / h)
//   corner and edge    c = (u^2 + d^2) / (2 d)   exposure 2 asinh(u1 / d) - 2 asinh(u0 / d)
// with 2 h between the corners, u from the middle between them; d from the corner to the line of the edge,
// u from the corner's foot on it. Lengths in m.
#pragma once

#include "outrider/geometry/convex.hpp"

namespace outrider {

/// What the axis keeps away from: an edge without its ends, or a corner (a == b).
struct Feature {
  Vec2 a;
  Vec2 b;

  [[nodiscard]] bool is_corner() const { return a == b; }
};

struct Bisector {
  enum class Kind { edges, corners, parabola };

  Kind kind = Kind::edges;
  Vec2 origin;         ///< where u is 0: on the line, or on the edge below the corner
  Vec2 along;          ///< unit vector of growing u
  Vec2 across;         ///< parabola: from the edge towards the corner
  double apart = 0.0;  ///< h or d; of edges c0
  double slope = 0.0;  ///< of edges k
  double u0 = 0.0;
  double u1 = 0.0;

  /// Between two points that are equally far from both features.
  static Bisector between(const Feature& one, const Feature& other, Vec2 from, Vec2 to);

  [[nodiscard]] Vec2 at(double u) const;
  [[nodiscard]] double clearance(double u) const;
  /// The least between u0 and u1.
  [[nodiscard]] double least_clearance() const;
  /// Between u0 and u1.
  [[nodiscard]] double length() const;
  [[nodiscard]] double exposure() const;
  /// The u between u0 and u1 that belongs to a point on the piece, or near it.
  [[nodiscard]] double u_of(Vec2 p) const;
  /// The part between two u, in either direction.
  [[nodiscard]] Bisector part(double from, double to) const;
};

}  // namespace outrider
