#include "ground/slab_cuts.hpp"

#include <gtest/gtest.h>

#include "ground/sweep_cells.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider::cover {
namespace {

double lanes_m(const std::vector<SweepCell>& cells) {
  double length = 0.0;
  for (const SweepCell& cell : cells) {
    for (const Segment& lane : cell.lanes) length += distance(lane.a, lane.b);
  }
  return length;
}

TEST(SlabCuts, ATaperHasFullSlabsWhereItIsNarrow) {
  // Three strides and a bit: with the bit at the tip the lanes are 10 (3.1 + 2.1 + 1.1 + 0.1) / 3.1.
  const RingedPolygon needle{{{0, 0}, {10, 0}, {10, 3.1}}, {}};
  const auto cuts = slab_cuts(needle, 1.0, 0.0);
  ASSERT_EQ(cuts.size(), 5U);
  EXPECT_NEAR(cuts[3], 3.0, 1e-4) << "the thin slab is the short one";
  const double lanes = lanes_m(sweep_cells({needle}, 0.0, 1.0, 0.01));
  EXPECT_NEAR(lanes, 64.0 / 3.1, 0.01) << "even slabs have 25 m";
}

TEST(SlabCuts, StepsAreCutWhereTheyAre) {
  // A column 0.6 wide and 10 high beside a floor 1 high: one long lane, not two.
  const RingedPolygon hook{{{0, 0}, {3.7, 0}, {3.7, 1}, {2.1, 1}, {2.1, 10}, {1.5, 10}, {1.5, 1}, {0, 1}},
                           {}};
  const auto cells = sweep_cells({hook}, 0.5 * 3.14159265358979, 1.0, 0.01);
  int long_lanes = 0;
  for (const SweepCell& cell : cells) {
    for (const Segment& lane : cell.lanes) long_lanes += distance(lane.a, lane.b) > 5.0 ? 1 : 0;
  }
  EXPECT_EQ(long_lanes, 1);
}

/// Slabs are no higher than the stride and cover everything, whatever the polygon.
TEST(SlabCuts, NoSlabIsHigherThanTheStride) {
  Rng rng(4);
  for (int k = 0; k < testing::cases(20); ++k) {
    const Region region = region_of(testing::random_star(rng, {0, 0}, 2.0, 6.0, 9), {});
    const double stride = rng.uniform(0.2, 1.5);
    const auto cuts = slab_cuts(region.front(), stride, rng.uniform(0.0, 2.0));
    const Box2 box = bounds_of(region);
    EXPECT_EQ(cuts.front(), box.low.y);
    EXPECT_EQ(cuts.back(), box.high.y);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      EXPECT_GT(cuts[i], cuts[i - 1]);
      EXPECT_LE(cuts[i] - cuts[i - 1], stride * (1.0 + 1e-6));
    }
  }
}

}  // namespace
}  // namespace outrider::cover
