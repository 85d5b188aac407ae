#include "outrider/jobs/cover/ground/coverage.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const Region plane = region_of({{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, {});

TEST(Coverage, OneLegIsACapsule) {
  const Coverage coverage = coverage_of({{0, 0}, {3, 0}}, 0.5, plane);
  EXPECT_NEAR(coverage.covered_m2, 3.0 + 0.25 * pi, 0.003);
  EXPECT_EQ(coverage.overlap_m2, 0.0);
  EXPECT_NEAR(coverage.missed_m2 + coverage.covered_m2, 10000.0, 1e-6);
}

TEST(Coverage, ThereAndBackIsTwiceButForTheTurn) {
  const Coverage coverage = coverage_of({{0, 0}, {3, 0}, {0, 0}}, 0.5, plane);
  EXPECT_NEAR(coverage.covered_m2, 3.0 + 0.25 * pi, 0.004);
  EXPECT_NEAR(coverage.overlap_m2, 3.0, 0.01);  // the disk about the turning point counts once
}

TEST(Coverage, NothingIsCoveredByNoWay) {
  const Coverage coverage = coverage_of({}, 0.5, region_of({{0, 0}, {1, 0}, {1, 1}}, {}));
  EXPECT_EQ(coverage.fraction, 0.0);
  EXPECT_NEAR(coverage.missed_m2, 0.5, 1e-9);
  EXPECT_EQ(coverage_of({{0, 0}}, 1.0, {}).fraction, 1.0);
}

/// Areas against a count on a raster, along random paths that cross and overlap themselves.
TEST(Coverage, AgreesWithARaster) {
  Rng rng(5);
  constexpr double cell = 0.02;
  for (int k = 0; k < testing::cases(6); ++k) {
    std::vector<Vec2> way;
    for (std::uint64_t i = 3 + rng.below(12); i > 0; --i) way.push_back(testing::random_point(rng, 2.0));
    if (rng.below(2) == 0) way.insert(way.end(), way.rbegin() + 1, way.rend());
    const double radius = rng.uniform(0.1, 0.5);
    const Region area = region_of(testing::random_star(rng, {0, 0}, 1.5, 2.5, 8), {});
    const Coverage coverage = coverage_of(way, radius, area);
    double covered = 0.0, overlap = 0.0, all = 0.0;
    for (double x = -2.5 + 0.5 * cell; x < 2.5; x += cell) {
      for (double y = -2.5 + 0.5 * cell; y < 2.5; y += cell) {
        if (!contains(area, {x, y})) continue;
        const int passes = testing::passes_over({x, y}, way, radius);
        all += cell * cell;
        covered += passes >= 1 ? cell * cell : 0.0;
        overlap += passes >= 2 ? cell * cell : 0.0;
      }
    }
    EXPECT_NEAR(coverage.covered_m2, covered, 0.005 * all) << "case " << k;
    EXPECT_NEAR(coverage.missed_m2, all - covered, 0.005 * all) << "case " << k;
    EXPECT_NEAR(coverage.overlap_m2, overlap, 0.007 * all) << "case " << k;
    EXPECT_NEAR(coverage.fraction, covered / all, 0.005) << "case " << k;
  }
}

/// The area covered until then, stretch by stretch, against the whole way until then.
TEST(Coverage, GrowsAlongTheWay) {
  Rng rng(8);
  for (int k = 0; k < testing::cases(4); ++k) {
    const Region area = region_of(testing::random_star(rng, {0, 0}, 1.5, 2.5, 8), {});
    const double radius = rng.uniform(0.1, 0.5);
    std::vector<std::vector<Vec2>> stretches;
    std::vector<Vec2> way{testing::random_point(rng, 2.0)};
    for (int i = 0; i < 6; ++i) {
      std::vector<Vec2> stretch{way.back()};
      for (std::uint64_t legs = rng.below(4); legs > 0; --legs)
        stretch.push_back(testing::random_point(rng, 2.0));
      way.insert(way.end(), stretch.begin() + 1, stretch.end());
      stretches.push_back(std::move(stretch));
    }
    GrowingCoverage growing(radius, area);
    std::vector<CoverageSums> sums;
    for (const auto& stretch : stretches) sums.push_back(growing.add(stretch));
    ASSERT_EQ(sums.size(), stretches.size());
    std::size_t points = 1;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      points += stretches[i].size() - 1;
      const Coverage whole =
          coverage_of({way.begin(), way.begin() + static_cast<std::ptrdiff_t>(points)}, radius, area);
      EXPECT_NEAR(sums[i].covered_m2, whole.covered_m2, 0.005 * area_of(area)) << k << ", stretch " << i;
      EXPECT_NEAR(sums[i].overlap_m2, whole.overlap_m2, 0.01 * area_of(area)) << k << ", stretch " << i;
    }
  }
}

/// Each turn of a robot that circles wider and wider covers little but what is covered already.
TEST(GrowingCoverage, OfCirclesThatOverlapIsThatOfTheWholeWay) {
  const Region area = region_of({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {});
  GrowingCoverage growing(0.3, area);
  std::vector<Vec2> way{{0.4, 0.0}};
  for (int section = 1; section <= 40; ++section) {  // of a quarter of a turn
    std::vector<Vec2> driven{way.back()};
    for (int i = 1; i <= 6; ++i) {
      const double turns = 0.25 * (section - 1 + i / 6.0);
      driven.push_back((0.4 + 0.02 * turns) * direction(2.0 * pi * turns));
    }
    way.insert(way.end(), driven.begin() + 1, driven.end());
    const CoverageSums sums = growing.add(driven);
    if (section % 20 != 0) continue;
    const Coverage whole = coverage_of(way, 0.3, area);
    EXPECT_NEAR(sums.covered_m2, whole.covered_m2, 1e-3) << section;
    EXPECT_NEAR(sums.overlap_m2, whole.overlap_m2, 0.02) << section;
  }
}

}  // namespace
}  // namespace outrider
