#include "outrider/geometry/convex.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::area_of;
using testing::cases;
using testing::inside;
using testing::random_convex_polygon;
using testing::random_point;
using testing::random_rounded_polygon;

constexpr double inf = std::numeric_limits<double>::infinity();

/// The nearest of many points along the segment: at most the step above the true distance.
double sampled_distance(Vec2 p, Segment s, int steps) {
  double nearest = inf;
  for (int i = 0; i <= steps; ++i) {
    nearest = std::min(nearest, distance(p, s.a + static_cast<double>(i) / steps * (s.b - s.a)));
  }
  return nearest;
}

/// Signed distance to the core by its definition, edge by edge.
double core_distance(Vec2 p, const std::vector<Vec2>& core) {
  double nearest = inf;
  for (std::size_t i = 0; i < core.size(); ++i) {
    nearest = std::min(nearest, distance(p, Segment{core[i], core[(i + 1) % core.size()]}));
  }
  return inside(p, core) ? -nearest : nearest;
}

TEST(ConvexHull, IsTheHullOnALattice) {
  Rng rng(1);
  for (int round = 0; round < cases(500); ++round) {
    std::vector<Vec2> points(1 + rng.below(30));
    for (Vec2& p : points) p = {static_cast<double>(rng.below(7)), static_cast<double>(rng.below(7))};
    const std::vector<Vec2> hull = convex_hull(points);
    for (const Vec2 corner : hull) EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
    if (hull.size() < 3) {  // then every point lies on the segment between the two ends
      for (const Vec2 p : points) EXPECT_EQ(distance(p, Segment{hull.front(), hull.back()}), 0.0);
      continue;
    }
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 a = hull[i];
      const Vec2 b = hull[(i + 1) % hull.size()];
      const Vec2 c = hull[(i + 2) % hull.size()];
      EXPECT_GT(cross(b - a, c - b), 0.0) << "strictly convex, counter-clockwise";
      for (const Vec2 p : points) EXPECT_GE(cross(b - a, p - a), 0.0) << "holds every point";
    }
  }
}

TEST(ConvexHull, DegenerateInputs) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}, {1, 1}}), (std::vector<Vec2>{{1, 1}}));
  EXPECT_EQ(convex_hull({{2, 2}, {0, 0}, {1, 1}}), (std::vector<Vec2>{{0, 0}, {2, 2}}));
}

TEST(Clip, KeepsWhatLiesInBoth) {
  Rng rng(2);
  for (int round = 0; round < cases(300); ++round) {
    const std::vector<Vec2> polygon = random_convex_polygon(rng, 2.0);
    const Vec2 normal = direction(rng.uniform(-pi, pi));
    const double offset = rng.uniform(-2.0, 2.0);
    const std::vector<Vec2> kept = clip(polygon, normal, offset);
    const std::vector<Vec2> rest = clip(polygon, -normal, -offset);
    EXPECT_NEAR(area_of(kept) + area_of(rest), area_of(polygon), 1e-12);
    for (const Vec2 p : kept) {
      EXPECT_LE(dot(normal, p), offset + 1e-12);
      EXPECT_TRUE(inside(p, polygon, 1e-12));
    }
    for (int i = 0; i < 20; ++i) {
      const Vec2 p = random_point(rng, 3.0);
      const bool expected = inside(p, polygon) && dot(normal, p) <= offset;
      if (std::abs(dot(normal, p) - offset) < 1e-9) continue;
      EXPECT_EQ(inside(p, kept), expected);
    }
  }
}

TEST(Clip, APolygonOnTheLineIsKeptWhole) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(clip(square, {1, 0}, 1.0), square);
  EXPECT_TRUE(clip(square, {1, 0}, -0.1).empty());
  EXPECT_TRUE(clip({}, {1, 0}, 0.0).empty());
}

TEST(Distance, PointToSegmentAgainstSampling) {
  Rng rng(3);
  for (int round = 0; round < cases(300); ++round) {
    const Segment s{random_point(rng, 1.0), random_point(rng, 1.0)};
    const Vec2 p = random_point(rng, 2.0);
    const double sampled = sampled_distance(p, s, 1000);
    EXPECT_LE(distance(p, s), sampled + 1e-12);
    EXPECT_GE(distance(p, s), sampled - distance(s.a, s.b) / 1000);
  }
  EXPECT_EQ(distance(Vec2{3, 4}, Segment{{0, 0}, {0, 0}}), 5.0);
}

TEST(Distance, SegmentToSegmentAgainstSampling) {
  Rng rng(4);
  int meetings = 0;
  for (int round = 0; round < cases(500); ++round) {
    const Segment s{random_point(rng, 1.0), random_point(rng, 1.0)};
    const Segment t{random_point(rng, 1.0), random_point(rng, 1.0)};
    double sampled = inf;
    for (int i = 0; i <= 500; ++i) {
      sampled = std::min(sampled, distance(s.a + i / 500.0 * (s.b - s.a), t));
    }
    const double exact = distance(s, t);
    meetings += exact == 0.0 ? 1 : 0;
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_GE(exact, sampled - distance(s.a, s.b) / 500);
    EXPECT_NEAR(exact, distance(t, s), 1e-12);
  }
  EXPECT_GT(meetings, 50);
}

TEST(Distance, SegmentsThatTouch) {
  EXPECT_EQ(distance(Segment{{0, 0}, {2, 0}}, Segment{{1, 0}, {1, 5}}), 0.0);  // a T
  EXPECT_EQ(distance(Segment{{0, 0}, {2, 0}}, Segment{{2, 0}, {3, 1}}), 0.0);  // a shared end
  EXPECT_EQ(distance(Segment{{0, 0}, {2, 0}}, Segment{{1, 0}, {3, 0}}), 0.0);  // an overlap
  EXPECT_EQ(distance(Segment{{0, 0}, {2, 0}}, Segment{{3, 0}, {5, 0}}), 1.0);  // in line, apart
  EXPECT_EQ(distance(Segment{{0, 0}, {2, 0}}, Segment{{0, 1}, {2, 1}}), 1.0);  // parallel
}

TEST(SignedDistance, OfAPointByDefinition) {
  Rng rng(5);
  for (int round = 0; round < cases(2000); ++round) {
    const RoundedPolygon shape = random_rounded_polygon(rng, 1.0);
    const Vec2 p = random_point(rng, 2.5);
    EXPECT_NEAR(signed_distance(p, shape), core_distance(p, shape.core) - shape.radius_m, 1e-12);
  }
}

TEST(SignedDistance, OfASegmentAgainstSampling) {
  Rng rng(6);
  int meetings = 0;
  for (int round = 0; round < cases(1000); ++round) {
    const RoundedPolygon shape = random_rounded_polygon(rng, 1.0);
    const Segment s{random_point(rng, 2.0), random_point(rng, 2.0)};
    double sampled = inf;
    for (int i = 0; i <= 400; ++i) {
      const double d = core_distance(s.a + i / 400.0 * (s.b - s.a), shape.core);
      sampled = std::min(sampled, std::max(d, 0.0));
    }
    const double exact = signed_distance(s, shape) + shape.radius_m;
    meetings += exact == 0.0 ? 1 : 0;
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_GE(exact, sampled - distance(s.a, s.b) / 400);
  }
  EXPECT_GT(meetings, 100);
}

TEST(RoundedPolygon, BoundsAreTheSupportInFourDirections) {
  Rng rng(7);
  for (int round = 0; round < cases(100); ++round) {
    const RoundedPolygon shape = random_rounded_polygon(rng, 1.0);
    const Box2 box = shape.bounds();
    const auto support = [&](Vec2 n) {
      double most = -inf;
      for (const Vec2 p : shape.core) most = std::max(most, dot(n, p));
      return most + shape.radius_m;
    };
    EXPECT_DOUBLE_EQ(box.high.x, support({1, 0}));
    EXPECT_DOUBLE_EQ(box.high.y, support({0, 1}));
    EXPECT_DOUBLE_EQ(box.low.x, -support({-1, 0}));
    EXPECT_DOUBLE_EQ(box.low.y, -support({0, -1}));
  }
}

TEST(RoundedPolygon, AreaIsTheLimitOfCircumscribedPolygons) {
  Rng rng(8);
  for (int round = 0; round < cases(100); ++round) {
    const RoundedPolygon shape = random_rounded_polygon(rng, 1.0);
    const double around = area_of(circumscribed(shape, 1e-3));
    EXPECT_GE(around, shape.area() - 1e-9);
    EXPECT_NEAR(around, shape.area(), 1e-6);
  }
}

TEST(Circumscribed, HoldsTheShapeAndStaysNear) {
  Rng rng(9);
  for (int round = 0; round < cases(300); ++round) {
    const RoundedPolygon shape = random_rounded_polygon(rng, 1.0);
    const double step = rng.uniform(0.05, 1.5);
    const std::vector<Vec2> corners = circumscribed(shape, step);
    const double reach = shape.radius_m / std::cos(step / 2);
    for (const Vec2 corner : corners) {
      EXPECT_LE(core_distance(corner, shape.core), reach + 1e-9);
      EXPECT_GE(core_distance(corner, shape.core), shape.radius_m - 1e-9);
    }
    for (const Vec2 corner : shape.core) {
      for (double heading = 0.0; heading < 2 * pi; heading += 0.1) {
        const Vec2 rim = corner + shape.radius_m * direction(heading);
        const double out = core_distance(rim, corners);
        EXPECT_LE(out, 1e-9) << "a part of the shape stands outside";
      }
    }
  }
}

TEST(Inscribed, LiesInTheShapeAndStaysNearItsBorder) {
  Rng rng(11);
  for (int round = 0; round < cases(300); ++round) {
    const RoundedPolygon shape = random_rounded_polygon(rng, 1.0);
    const double step = rng.uniform(0.05, 1.5);
    const std::vector<Vec2> corners = inscribed(shape, step);
    const double lost = shape.radius_m * (1.0 - std::cos(step / 2));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 next = corners[(i + 1) % corners.size()];
      for (const double part : {0.0, 0.3, 0.5, 0.9}) {
        const double away = core_distance(corners[i] + part * (next - corners[i]), shape.core);
        EXPECT_LE(away, shape.radius_m + 1e-9);
        EXPECT_GE(away, shape.radius_m - lost - 1e-9);
      }
    }
  }
}

TEST(Cut, IsThePartOfTheRayInside) {
  Rng rng(10);
  int cuts = 0;
  for (int round = 0; round < cases(500); ++round) {
    const std::vector<Vec2> polygon = random_convex_polygon(rng, 1.0);
    const Vec2 origin = random_point(rng, 2.0);
    const Vec2 along = rng.uniform(0.5, 3.0) * direction(rng.uniform(-pi, pi));
    const std::optional<Interval> interval = cut(polygon, origin, along, -1.0, 2.0);
    cuts += interval ? 1 : 0;
    for (int i = 0; i <= 300; ++i) {
      const double t = -1.0 + 0.01 * i;
      const double depth = -core_distance(origin + t * along, polygon);
      if (std::abs(depth) < 1e-9) continue;
      EXPECT_EQ(depth > 0.0, interval && t >= interval->low && t <= interval->high);
    }
  }
  EXPECT_GT(cuts, 50);
}

TEST(Cut, RaysAlongAnEdgeAndBesideIt) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto along = cut(square, {-1, 0}, {1, 0}, 0.0, 5.0);
  ASSERT_TRUE(along);
  EXPECT_EQ(along->low, 1.0);
  EXPECT_EQ(along->high, 2.0);
  EXPECT_FALSE(cut(square, {-1, -1e-9}, {1, 0}, 0.0, 5.0));
  EXPECT_FALSE(cut(square, {-1, 0.5}, {1, 0}, 0.0, 0.9)) << "ends before";
  EXPECT_FALSE(cut(square, {-1, 0.5}, {1, 0}, 2.1, 5.0)) << "starts behind";
}

}  // namespace
}  // namespace outrider
