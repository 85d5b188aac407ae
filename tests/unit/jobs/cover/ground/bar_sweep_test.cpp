#include "ground/bar_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "support/cover_areas.hpp"
#include "support/dense_bar.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using cover::Approximation;

const Region wide_plane = region_of({{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, {});

/// Straight on, backwards, in place, along arcs either way.
std::vector<Pose2> random_drive(Rng& rng, int motions) {
  std::vector<Pose2> poses{{testing::random_point(rng, 1.0), rng.uniform(-pi, pi)}};
  for (int i = 0; i < motions; ++i) {
    Pose2 at = poses.back();
    switch (rng.below(3)) {
      case 0: at.heading_rad += rng.uniform(-pi, pi); break;
      case 1: at.position = at.position + rng.uniform(-1.5, 1.5) * direction(at.heading_rad); break;
      default: {
        const double radius = rng.uniform(0.3, 1.5) * (rng.below(2) == 0 ? 1.0 : -1.0),
                     turn = rng.uniform(-2.0, 2.0);
        const Vec2 centre = at.position + radius * perpendicular(direction(at.heading_rad));
        at = {centre - radius * perpendicular(direction(at.heading_rad + turn)), at.heading_rad + turn};
      }
    }
    if (norm(at.position) < 2.0) poses.push_back(at);
  }
  return poses;
}

TEST(BarSweep, AStraightStrokeIsARectangle) {
  const Coverage coverage = coverage_of({Pose2{{0, 0}, 0}, Pose2{{5, 0}, 0}}, Bar{1.2, 0.3, 0.4}, wide_plane);
  EXPECT_NEAR(coverage.covered_m2, 5.3 * 1.2, 1e-5);
  const Box2 box = bounds_of(coverage.covered);
  EXPECT_NEAR(box.low.x, 0.25, 1e-6);
  EXPECT_NEAR(box.high.x, 5.55, 1e-6);
  EXPECT_EQ(coverage.overlap_m2, 0.0);
}

TEST(BarSweep, ATurnInPlaceIsARing) {
  const Bar bar{1.2, 0.3, 0.4};
  const Coverage coverage = coverage_of({Pose2{{0, 0}, 0}, Pose2{{0, 0}, 2.0 * pi}}, bar, wide_plane);
  const double ring = pi * (std::pow(bar.reach_m(), 2) - 0.25 * 0.25);
  EXPECT_LT(coverage.covered_m2, ring);
  EXPECT_GT(coverage.covered_m2, 0.999 * ring);
}

TEST(BarSweep, ThereAndBackIsOverlapButForTheBarItself) {
  const Coverage coverage =
      coverage_of({Pose2{{0, 0}, 0}, Pose2{{5, 0}, 0}, Pose2{{0, 0}, 0}}, Bar{1.0, 0.5, 2.0}, wide_plane);
  EXPECT_NEAR(coverage.covered_m2, 5.5, 1e-4);
  EXPECT_NEAR(coverage.overlap_m2, 5.0, 1e-3);
}

/// Random drives of random bars against the twin: areas, and every point of a raster.
TEST(BarSweep, AgreesWithADenseRaster) {
  Rng rng(21);
  constexpr double cell = 0.04, near_m = 0.012;
  for (int k = 0; k < testing::cases(4); ++k) {
    const Bar bar = testing::random_bar(rng);
    const std::vector<Pose2> poses = random_drive(rng, 4 + static_cast<int>(rng.below(10)));
    const Region area = region_of(testing::random_star(rng, {0, 0}, 1.5, 2.5, 8), {});
    const Coverage coverage = coverage_of(poses, bar, area);
    const testing::DenseBar twin(poses, bar, 0.01);
    double covered = 0.0, overlap = 0.0, all = 0.0;
    for (double x = -2.5 + 0.5 * cell; x < 2.5; x += cell) {
      for (double y = -2.5 + 0.5 * cell; y < 2.5; y += cell) {
        const Vec2 p{x, y};
        if (!contains(area, p)) continue;
        const int passes = twin.passes_over(p);
        all += cell * cell;
        covered += passes >= 1 ? cell * cell : 0.0;
        overlap += passes >= 2 ? cell * cell : 0.0;
        if (contains(coverage.covered, p))
          EXPECT_GE(twin.passes_over(p, near_m), 1) << "never under the bar; case " << k;
        else
          EXPECT_EQ(twin.passes_over(p, -near_m), 0) << "under the bar; case " << k;
      }
    }
    EXPECT_NEAR(coverage.covered_m2, covered, 0.01 * all) << "case " << k;
    EXPECT_NEAR(coverage.missed_m2, all - covered, 0.01 * all) << "case " << k;
    EXPECT_NEAR(coverage.overlap_m2, overlap, 0.02 * all) << "case " << k;
  }
}

/// Inside of the true sweep and around it, and little between the two.
TEST(BarSweep, TheTrueSweepLiesBetweenBothApproximations) {
  Rng rng(22);
  for (int k = 0; k < testing::cases(10); ++k) {
    const Bar bar = testing::random_bar(rng);
    const auto poses = cover::with_small_turns(random_drive(rng, 6));
    const testing::DenseBar twin(poses, bar, 0.002);
    std::vector<Region> inside, around;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      inside.push_back(cover::bar_sweep(poses[i - 1], poses[i], bar, Approximation::inside));
      around.push_back(cover::bar_sweep(poses[i - 1], poses[i], bar, Approximation::around));
    }
    const Region in = united(inside), out = united(around);
    EXPECT_LT(area_of(without(in, out)), 1e-5);
    EXPECT_LT(area_of(out) - area_of(in), 0.01 * area_of(out) + 1e-5) << "case " << k;
    for (int i = 0; i < 400; ++i) {
      const Vec2 p = testing::random_point(rng, 3.0);
      EXPECT_TRUE(!contains(in, p) || twin.passes_over(p, 0.003) > 0) << "case " << k;
      EXPECT_TRUE(contains(out, p) || twin.passes_over(p, -1e-5) == 0) << "case " << k;
    }
  }
}

/// Section by section, against the whole drive.
TEST(BarSweep, GrowsAlongTheWay) {
  Rng rng(23);
  for (int k = 0; k < testing::cases(4); ++k) {
    const Bar bar = testing::random_bar(rng);
    const Region area = region_of(testing::random_star(rng, {0, 0}, 1.5, 2.5, 8), {});
    std::vector<Pose2> poses = random_drive(rng, 12);
    GrowingCoverage growing(bar, area);
    CoverageSums sums;
    for (std::size_t i = 0; i < poses.size(); i += 3) {
      const std::size_t end = std::min(poses.size(), i + 4);
      sums = growing.add(std::vector<Pose2>(poses.begin() + static_cast<std::ptrdiff_t>(i),
                                            poses.begin() + static_cast<std::ptrdiff_t>(end)));
    }
    const Coverage whole = coverage_of(poses, bar, area);
    EXPECT_NEAR(sums.covered_m2, whole.covered_m2, 1e-4 * area_of(area));
    EXPECT_NEAR(sums.overlap_m2, whole.overlap_m2, 0.01 * area_of(area));
  }
}

}  // namespace
}  // namespace outrider
