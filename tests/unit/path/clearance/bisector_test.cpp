#include "clearance/bisector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

double to_feature(Vec2 p, const Feature& f) {
  if (f.is_corner()) return distance(p, f.a);
  return std::abs(cross(f.b - f.a, p - f.a)) / distance(f.a, f.b);
}

/// The point of a line from `p` along `way` that is as far from both, by bisection; the features are on
/// different sides of it.
Vec2 midway(Vec2 p, Vec2 way, const Feature& one, const Feature& other) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.5 * (low + high);
    const Vec2 q = p + t * way;
    (to_feature(q, one) < to_feature(q, other) ? low : high) = t;
  }
  return p + low * way;
}

/// Clearance, length and exposure of a piece between two features, against many small steps along it.
void expect_closed_forms(const Feature& one, const Feature& other, Vec2 from, Vec2 to) {
  const Bisector piece = Bisector::between(one, other, from, to);
  ASSERT_LT(distance(piece.at(piece.u0), from), 1e-9);
  ASSERT_LT(distance(piece.at(piece.u1), to), 1e-9);
  ASSERT_NEAR(distance(piece.at(piece.u_of(to)), to), 0.0, 1e-9);
  constexpr int steps = 4000;
  double length = 0.0, exposure = 0.0, least = 1e300;
  Vec2 before = from;
  for (int i = 1; i <= steps; ++i) {
    const Vec2 p = piece.at(piece.u0 + (piece.u1 - piece.u0) * i / steps);
    const double near = to_feature(p, one);
    ASSERT_NEAR(near, to_feature(p, other), 1e-9 * (1.0 + near));
    ASSERT_NEAR(near, piece.clearance(piece.u0 + (piece.u1 - piece.u0) * i / steps), 1e-9 * (1.0 + near));
    const double step = distance(before, p);
    length += step;
    exposure += step / to_feature(0.5 * (before + p), one);
    least = std::min({least, near, to_feature(before, one)});
    before = p;
  }
  EXPECT_NEAR(piece.length(), length, 1e-5 * length);
  EXPECT_NEAR(piece.exposure(), exposure, 1e-5 * exposure);
  EXPECT_NEAR(piece.least_clearance(), least, 1e-5 * least);
  const double middle = 0.3 * piece.u0 + 0.7 * piece.u1;
  const Bisector first = piece.part(piece.u0, middle), back = piece.part(piece.u1, middle);
  EXPECT_NEAR(first.length() + back.length(), piece.length(), 1e-9 * length);
  EXPECT_NEAR(first.exposure() + back.exposure(), piece.exposure(), 1e-9 * exposure);
}

TEST(Bisector, ClosedFormsAreWhatSmallStepsAddUpTo) {
  Rng rng = Rng(61).child("bisector");
  for (int i = 0; i < testing::cases(50); ++i) {
    const double turn = rng.uniform(0.0, 6.2);
    const auto place = [&](double x, double y) {
      return Vec2{std::cos(turn) * x - std::sin(turn) * y + 3.0,
                  std::sin(turn) * x + std::cos(turn) * y - 2.0};
    };
    const Feature floor{place(-9, 0), place(9, 0)};
    const Feature roof{place(-9, rng.uniform(1.0, 2.0)), place(9, rng.uniform(1.0, 2.0))};
    const double height = rng.uniform(0.5, 2.0), x0 = rng.uniform(-2.0, 0.5), x1 = x0 + rng.uniform(0.3, 2.0);
    const Vec2 above = place(0.0, height), below = place(0.0, -height);
    const Vec2 up = place(0, 1) - place(0, 0);
    const auto on = [&](const Feature& one, const Feature& other, double x, double from, double to) {
      return midway(place(x, from), (to - from) * up, one, other);
    };
    const Feature high{above, above}, low{below, below};
    expect_closed_forms(floor, roof, on(floor, roof, x0, 0.0, 2.5), on(floor, roof, x1, 0.0, 2.5));
    expect_closed_forms(low, high, place(x0, 0.0), place(x1, 0.0));
    expect_closed_forms(floor, high, on(floor, high, x0, 0.0, 20.0), on(floor, high, x1, 0.0, 20.0));
  }
}

}  // namespace
}  // namespace outrider
