#include "research/guard/heading_cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

Vec2 vector(Cell cell) { return {static_cast<double>(cell.x), static_cast<double>(cell.y)}; }

/// Coordinates along the steps p and q of a cone.
Vec2 in_steps(const HeadingCone& cone, Vec2 point) {
  const Vec2 p = vector(cone.p.step), q = vector(cone.q.step);
  return {cross(point, q) / cross(p, q), cross(p, point) / cross(p, q)};
}

double measure(const HeadingCone& cone, Vec2 way) {
  const Vec2 steps = in_steps(cone, way);
  return steps.x * cone.p.weight + steps.y * cone.q.weight;
}

Cell tile_of(const HeadingCone& cone, Vec2 point) {
  const Vec2 steps = in_steps(cone, point);
  const auto p = static_cast<int>(std::floor(steps.x)), q = static_cast<int>(std::floor(steps.y));
  return {p * cone.p.step.x + q * cone.q.step.x, p * cone.p.step.y + q * cone.q.step.y};
}

Cell cell_of(Vec2 point) {
  return {static_cast<int>(std::floor(point.x + 0.5)), static_cast<int>(std::floor(point.y + 0.5))};
}

TEST(ResearchHeadingCones, CoverTheCircleOnce) {
  double from = 0.0;
  for (const HeadingCone& cone : heading_cones()) {
    EXPECT_NEAR(wrap_angle(cone.middle_rad - cone.half_width_rad - from), 0.0, 1e-12);
    from += 2.0 * cone.half_width_rad;
  }
  EXPECT_NEAR(from, 2.0 * pi, 1e-12);
}

TEST(ResearchHeadingCones, MeasureLengthsFromBelow) {
  Rng rng(401);
  const std::vector<HeadingCone> all = heading_cones();
  for (int i = 0; i < cases(2000); ++i) {
    const HeadingCone& cone = all[static_cast<std::size_t>(rng.uniform() * static_cast<double>(all.size()))];
    const double heading = cone.middle_rad + rng.uniform(-1.0, 1.0) * cone.half_width_rad;
    const double measured = measure(cone, direction(heading));
    EXPECT_LE(measured, heading_scale() + 1e-9);
    EXPECT_GE(measured, 0.97 * heading_scale());
  }
}

TEST(ResearchHeadingCones, AStraightDriveGoesFromTileToTileAheadThroughTheCellsThatAreNamed) {
  Rng rng(402);
  const std::vector<HeadingCone> all = heading_cones();
  const auto holds = [](const std::vector<Cell>& cells, Cell cell) {
    return std::find(cells.begin(), cells.end(), cell) != cells.end();
  };
  int crossings = 0;
  for (int i = 0; i < cases(300); ++i) {
    const HeadingCone& cone = all[static_cast<std::size_t>(i) % all.size()];
    const Vec2 ahead = direction(cone.middle_rad + rng.uniform(-0.99, 0.99) * cone.half_width_rad);
    const Vec2 start{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
    Vec2 before = start;
    Cell tile = tile_of(cone, start);
    for (double way = 0.0; way < 8.0; way += 1e-3) {
      const Vec2 now = start + way * ahead;
      const Cell next = tile_of(cone, now);
      const Cell cell = cell_of(now);
      const Cell apart{cell.x - next.x, cell.y - next.y};
      const auto overlap = std::find_if(cone.overlaps.begin(), cone.overlaps.end(),
                                        [&](const TileOverlap& one) { return one.cell == apart; });
      ASSERT_NE(overlap, cone.overlaps.end()) << i;
      const double from_vertex = measure(cone, now - vector(next));
      EXPECT_LE(overlap->least, from_vertex + 1e-9);
      EXPECT_GE(overlap->most, from_vertex - 1e-9);
      if (!(next == tile)) {
        const Cell step{next.x - tile.x, next.y - tile.y};
        const bool by_p = step == cone.p.step, by_q = step == cone.q.step;
        const bool by_both = step == Cell{cone.p.step.x + cone.q.step.x, cone.p.step.y + cone.q.step.y};
        EXPECT_TRUE(by_p || by_q || by_both) << i;
        const Cell crossed = cell_of(0.5 * (before + now));
        if (!by_both) {
          EXPECT_TRUE(holds((by_p ? cone.p : cone.q).cells, {crossed.x - tile.x, crossed.y - tile.y}) ||
                      norm(0.5 * (before + now) - vector(crossed)) > 0.49)
              << i;
          ++crossings;
        }
        tile = next;
      }
      before = now;
    }
  }
  EXPECT_GT(crossings, 1000);
}

TEST(ResearchHeadingCones, AnglesBetweenThemAreTheLeast) {
  Rng rng(403);
  const std::vector<HeadingCone> all = heading_cones();
  for (const HeadingCone& a : all) {
    for (const HeadingCone& b : all) {
      double least = pi;
      for (int k = 0; k < 200; ++k) {
        const auto edge = [&](const HeadingCone& cone) {
          return cone.middle_rad +
                 (k < 4 ? (k % 2 == 0 ? -1.0 : 1.0) : rng.uniform(-1.0, 1.0)) * cone.half_width_rad;
        };
        const double from = edge(a);
        const double to = b.middle_rad + (k / 2 % 2 == 0 ? -1.0 : 1.0) * b.half_width_rad;
        EXPECT_LE(a.angle_to(b), std::abs(wrap_angle(to - from)) + 1e-9);
        EXPECT_LE(a.angle_to(to), std::abs(wrap_angle(to - from)) + 1e-9);
        least = std::min(least, std::abs(wrap_angle(to - from)));
      }
      EXPECT_NEAR(a.angle_to(b), &a == &b ? 0.0 : least, 1e-9);
    }
  }
}

}  // namespace
}  // namespace outrider
