#include "outrider/control/rounded_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct Course {
  std::vector<Vec2> corners = {{0, 0}};
  std::vector<double> rooms;
};

Course random_course(Rng& rng) {
  Course course;
  double bearing = rng.uniform(-pi, pi);
  const std::size_t legs = 2 + rng.below(4);
  for (std::size_t i = 0; i < legs; ++i) {
    course.corners.push_back(course.corners.back() + rng.uniform(0.1, 1.5) * direction(bearing));
    bearing += rng.uniform(-2.0, 2.0);
    if (i + 1 < legs) course.rooms.push_back(rng.uniform(0.002, 0.15));
  }
  return course;
}

double nearest(const std::vector<PathPoint>& path, Vec2 to) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i)
    least = std::min(least, distance(to, Segment{path[i - 1].position, path[i].position}));
  return least;
}

TEST(RoundedPath, CutsEachCornerByItsRoomAtMost) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(100); ++round) {
    const Course course = random_course(rng);
    const auto path = rounded_path(course.corners, course.rooms, 0.01);
    EXPECT_EQ(path.front().position, course.corners.front());
    EXPECT_NEAR(distance(path.back().position, course.corners.back()), 0.0, 1e-12);
    for (std::size_t i = 0; i < course.rooms.size(); ++i)
      EXPECT_LE(nearest(path, course.corners[i + 1]), course.rooms[i] + 1e-9);
    for (const PathPoint& point : path) {
      double off = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i < course.corners.size(); ++i)
        off = std::min(off, distance(point.position, Segment{course.corners[i - 1], course.corners[i]}));
      EXPECT_LE(off, *std::ranges::max_element(course.rooms) + 1e-9);
    }
  }
}

TEST(RoundedPath, UsesTheRoomWhereTheLegsAreLong) {
  for (const double corner : {0.3, 1.0, 1.6, 2.3, -1.2}) {
    const Vec2 end = Vec2{5, 0} + 5.0 * direction(corner);
    const auto path = rounded_path({{0, 0}, {5, 0}, end}, {0.05}, 0.01);
    EXPECT_NEAR(nearest(path, {5, 0}), 0.05, 1e-4) << corner;
  }
}

/// Length, direction and curvature against differences of positions.
TEST(RoundedPath, ItsDerivativesAgreeWithItsPositions) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(50); ++round) {
    const Course course = random_course(rng);
    const auto path = rounded_path(course.corners, course.rooms, 0.01);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const PathPoint &a = path[i - 1], &b = path[i];
      const Vec2 chord = b.position - a.position;
      const double turn = b.tangent_rad - a.tangent_rad, length_m = b.along_m - a.along_m;
      EXPECT_GT(length_m, 0.0);
      EXPECT_LT(std::abs(turn), 0.5) << "points are close where the path bends";
      EXPECT_NEAR(norm(chord) / length_m, 1.0, 0.01);
      EXPECT_NEAR(wrap_angle(heading_of(chord) - 0.5 * (a.tangent_rad + b.tangent_rad)), 0.0,
                  0.02 + 0.25 * std::abs(turn));
      EXPECT_NEAR(turn, 0.5 * (a.curvature + b.curvature) * length_m, 0.02 + 0.1 * std::abs(turn));
    }
  }
}

TEST(RoundedPath, AStraightOneIsStraight) {
  const auto path = rounded_path({{0, 0}, {3, 4}}, {}, 0.1);
  EXPECT_GE(path.size(), 51U);
  EXPECT_NEAR(path.back().along_m, 5.0, 1e-12);
  for (const PathPoint& point : path) {
    EXPECT_EQ(point.curvature, 0.0);
    EXPECT_NEAR(distance(point.position, point.along_m * Vec2{0.6, 0.8}), 0.0, 1e-12);
  }
}

TEST(RoundedPath, ACornerWithoutRoomIsSharp) {
  const auto path = rounded_path({{0, 0}, {1, 0}, {1, 1}}, {0.0}, 0.1);
  EXPECT_EQ(nearest(path, {1, 0}), 0.0);
  EXPECT_NEAR(path.back().tangent_rad, pi / 2, 1e-12);
  EXPECT_NEAR(path.back().along_m, 2.0, 1e-12);
}

TEST(RoundedPath, OneCornerIsPartOfThePath) {
  const auto curve = rounded_corner({0, 0}, {1, 0}, {1, 1}, 0.05, 1.0, 1.0);
  const auto path = rounded_path({{0, 0}, {1, 0}, {1, 1}}, {0.05}, 0.01);
  for (const Vec2 p : curve) EXPECT_LE(nearest(path, p), 1e-12);
}

}  // namespace
}  // namespace outrider
