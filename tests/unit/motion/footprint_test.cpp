#include "outrider/motion/footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

const RoundedPolygon rectangle{{{-0.2, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {-0.2, 0.1}}, 0.0};

TEST(Footprint, KnowsItsDisks) {
  const Footprint footprint(rectangle);
  EXPECT_DOUBLE_EQ(footprint.inner_m(), 0.1);
  EXPECT_DOUBLE_EQ(footprint.outer_m(), std::hypot(0.3, 0.1));
  EXPECT_DOUBLE_EQ(footprint.gap_m({0.5, 0.0}), 0.2);
  EXPECT_DOUBLE_EQ(footprint.gap_m({0.25, 0.0}), -0.05);
  EXPECT_DOUBLE_EQ(Footprint::disk(0.3).inner_m(), 0.3);
  EXPECT_DOUBLE_EQ(Footprint::disk(0.3).outer_m(), 0.3);
}

/// The gap to a thing is that to the nearest of many points of its border, or less than 0 if one is inside.
TEST(Footprint, GapToAThingIsThatToItsNearestPoint) {
  Rng rng(1);
  const Footprint footprint(rectangle);
  int overlaps = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose2 pose{{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)}, rng.uniform(-pi, pi)};
    const RoundedPolygon thing{{{0.0, 0.0}, {0.4, 0.0}, {0.2, 0.3}}, rng.uniform(0.0, 0.2)};
    double nearest = 10.0;
    const auto border = inscribed(thing, 0.02);
    for (std::size_t k = 0; k < border.size(); ++k) {
      for (double t = 0.0; t < 1.0; t += 0.02) {
        const Vec2 point = border[k] + t * (border[(k + 1) % border.size()] - border[k]);
        nearest = std::min(nearest, footprint.gap_m(pose.to_local(point)));
      }
    }
    const double gap_m = footprint.gap_m(pose, thing);
    if (nearest > 0.0 && signed_distance(pose.position, thing) > 0.0)
      EXPECT_NEAR(gap_m, nearest, 0.005);
    else
      EXPECT_LE(gap_m, 0.0);
    overlaps += gap_m < 0.0;
  }
  EXPECT_GT(overlaps, 30);
  EXPECT_LT(overlaps, 270);
}

TEST(Footprint, IsRead) {
  const auto box = parse_footprint("-0.2,-0.1 0.3,-0.1 0.3,0.1 -0.2,0.1");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->core, rectangle.core);
  const auto disk = parse_footprint(" 0.25 ");
  ASSERT_TRUE(disk);
  EXPECT_EQ(disk->core.size(), 1U);
  EXPECT_EQ(disk->radius_m, 0.25);
}

TEST(Footprint, RefusesWhatIsNoFootprint) {
  for (const auto* text : {"", "0", "-1", "nan", "1,2", "1,2 3", "a", "0.1,0.1 x", "1 2 3", "0.1,0.1,0.1"}) {
    const auto refused = parse_footprint(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().where, "footprint");
  }
  EXPECT_FALSE(parse_footprint("-0.2,-0.1 -0.2,0.1 0.3,0.1 0.3,-0.1")) << "clockwise";
  EXPECT_FALSE(parse_footprint("-1,-1 1,-1 0,-0.9 1,1 -1,1")) << "not convex";
  EXPECT_FALSE(parse_footprint("1,1 2,1 2,2 1,2")) << "beside its origin";
  EXPECT_FALSE(parse_footprint("0,1 -0.59,-0.81 0.95,0.31 -0.95,0.31 0.59,-0.81")) << "a star";
  EXPECT_FALSE(parse_footprint("-0.2,-0.1 1e300,-0.1 0.3,0.1"));
}

}  // namespace
}  // namespace outrider
