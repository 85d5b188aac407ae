#include "ground/sweep_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider::cover {
namespace {

const std::vector<Vec2> square = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};

TEST(SweepCells, AHoleMakesFourCells) {
  const Region region = region_of(square, {{{2, 2}, {4, 2}, {4, 4}, {2, 4}}});
  for (const double heading : {0.0, 0.5 * pi}) {
    const auto cells = sweep_cells(region, heading, 0.5, 0.01);
    EXPECT_EQ(cells.size(), 4U) << "before, beside on both sides, and behind";
  }
}

TEST(SweepCells, OneCellWithEvenLanesWithoutAnObstacle) {
  const auto cells = sweep_cells(region_of(square, {}), 0.5 * pi, 0.5, 0.01);
  ASSERT_EQ(cells.size(), 1U);
  ASSERT_EQ(cells[0].lanes.size(), 12U);
  for (std::size_t i = 1; i < 12; ++i) {
    EXPECT_NEAR(std::abs(cells[0].lanes[i].a.x - cells[0].lanes[i - 1].a.x), 0.5, 1e-5);
  }
  EXPECT_NEAR(area_of(cells[0].area), 36.0, 1e-4);
}

/// The promises of the header, by points: cells are the region, and beside every point is its lane.
TEST(SweepCells, CellsAreTheRegionAndLanesPassBeside) {
  Rng rng(17);
  constexpr double stride = 0.3;
  for (int k = 0; k < testing::cases(10); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const Region region = region_of(problem.boundary, problem.holes);
    const auto cells = sweep_cells(region, rng.uniform(0.0, pi), stride, 0.01);
    double area = 0.0;
    for (const SweepCell& cell : cells) area += area_of(cell.area);
    EXPECT_NEAR(area, area_of(region), 1e-3) << k;
    for (int i = 0; i < 100; ++i) {
      const Vec2 p = testing::random_point(rng, 6.0);
      if (!contains(region, p)) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const SweepCell& cell : cells) {
        if (!contains(cell.area, p)) continue;
        for (const Segment& lane : cell.lanes) nearest = std::min(nearest, distance(p, lane));
      }
      EXPECT_LE(nearest, 0.5 * stride + 1e-4) << k;
    }
  }
}

}  // namespace
}  // namespace outrider::cover
