#include "outrider/navigate/surroundings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

/// A map with things at random places around the origin.
LiveMap strewn(Rng& rng, int count) {
  LiveMap map({}, {});
  for (int i = 0; i < count; ++i) map.note_touch({rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0)}, 0.0);
  return map;
}

const Footprint oblong({{{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}}, 0.0});

TEST(Surroundings, ClearanceIsTheDistanceToTheNearestMark) {
  Rng rng(3);
  const LiveMap map = strewn(rng, 60);
  Surroundings near;
  near.look(map, {0.3, -0.2}, 2.0);
  near.find_distances();
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 place{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)};
    double nearest = Surroundings::most_m;
    for (const Mark& mark : map.marks()) nearest = std::min(nearest, distance(mark.place, place));
    if (nearest < 0.15) continue;
    ++compared;
    EXPECT_LE(near.clearance(place), nearest + 0.003);
    EXPECT_GE(near.clearance(place), nearest - 0.025);
  }
  EXPECT_GT(compared, 1000);
}

TEST(Surroundings, GapOfAFootprintIsExact) {
  Rng rng(4);
  const LiveMap map = strewn(rng, 60);
  Surroundings near;
  near.look(map, {}, 2.0);
  near.find_distances();
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose{{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)}, rng.uniform(-3.0, 3.0)};
    double least = 0.3;
    for (const Mark& mark : map.marks()) least = std::min(least, oblong.gap_m(pose.to_local(mark.place)));
    EXPECT_NEAR(near.gap(oblong, pose, 0.3), least, 1e-12);
    touching += least < 0.0;
  }
  EXPECT_GT(touching, 20);
}

TEST(Surroundings, NothingIsNearInAnEmptyMap) {
  Surroundings near;
  near.look(LiveMap({}, {}), {}, 2.0);
  near.find_distances();
  EXPECT_NEAR(near.clearance({0.5, 0.5}), Surroundings::most_m, 1e-6);
  EXPECT_EQ(near.clearance({50.0, 0.0}), Surroundings::most_m);
  EXPECT_EQ(near.gap(oblong, {}, 0.3), 0.3);
}

}  // namespace
}  // namespace outrider
