#include "polygon_ground_predicates.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace outrider {
namespace {

/// An exact result hi + lo, where hi is its rounded value.
struct Exact {
  double hi = 0.0;
  double lo = 0.0;
};

Exact sum(double a, double b) {
  const double hi = a + b;
  const double part = hi - a;
  return {hi, (a - (hi - part)) + (b - part)};
}

Exact product(double a, double b) {
  const double hi = a * b;
  return {hi, std::fma(a, b, -hi)};
}

/// An exact sum of up to 16 doubles, in parts of growing magnitude.
struct ExactSum {
  std::array<double, 16> parts{};
  std::size_t count = 0;

  void add(double value) {
    for (std::size_t i = 0; i < count; ++i) {
      const Exact next = sum(value, parts[i]);
      parts[i] = next.lo;
      value = next.hi;
    }
    parts[count++] = value;
  }
  void add_product(Exact a, Exact b, double sign) {
    for (const double x : {a.lo, a.hi}) {
      for (const double y : {b.lo, b.hi}) {
        const Exact p = product(x, sign * y);
        add(p.lo);
        add(p.hi);
      }
    }
  }
  [[nodiscard]] int sign() const {
    for (std::size_t i = count; i-- > 0;) {
      if (parts[i] != 0.0) return parts[i] > 0.0 ? 1 : -1;
    }
    return 0;
  }
};

bool within_box(Vec2 p, Segment s) {
  Box2 box;
  box.include(s.a);
  box.include(s.b);
  return box.contains(p);
}

}  // namespace

int turn_of(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double rounded = left - right;
  if (std::abs(rounded) > 4e-16 * (std::abs(left) + std::abs(right))) return rounded > 0.0 ? 1 : -1;
  ExactSum exact;
  exact.add_product(sum(a.x, -c.x), sum(b.y, -c.y), 1.0);
  exact.add_product(sum(a.y, -c.y), sum(b.x, -c.x), -1.0);
  return exact.sign();
}

bool segments_meet(Segment s, Segment t) {
  const int a = turn_of(s.a, s.b, t.a), b = turn_of(s.a, s.b, t.b);
  const int c = turn_of(t.a, t.b, s.a), d = turn_of(t.a, t.b, s.b);
  if (a * b < 0 && c * d < 0) return true;
  return (a == 0 && within_box(t.a, s)) || (b == 0 && within_box(t.b, s)) || (c == 0 && within_box(s.a, t)) ||
         (d == 0 && within_box(s.b, t));
}

}  // namespace outrider
