#include "outrider/jobs/explore/map/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/world/occupancy.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

constexpr double wall_m = 0.1;

Solid block(Vec2 low, Vec2 high, double low_z_m = 0.0) {
  const Vec2 middle = 0.5 * (low + high);
  const Vec2 half = 0.5 * (high - low);
  return {"block", {{middle.x, middle.y, low_z_m + 0.25}, {}}, BoxShape{{half.x, half.y, 0.25}}};
}

/// Walls about the inside from 0,0.
World room(double width_m, double depth_m) {
  World world;
  world.solids = {block({-wall_m, -wall_m}, {width_m + wall_m, 0.0}),
                  block({-wall_m, depth_m}, {width_m + wall_m, depth_m + wall_m}),
                  block({-wall_m, 0.0}, {0.0, depth_m}), block({width_m, 0.0}, {width_m + wall_m, depth_m})};
  return world;
}

struct Eyes {
  RangeFinder laser;
  OpenGround ground;
};

Eyes eyes(const World& world, double most_m = 3.5) {
  RangeFinderModel model;
  model.most_m = most_m;
  return {RangeFinder(world, model), OpenGround(world, burger())};
}

TEST(ExplorationReference, ARoomIsSeenWhole) {
  const Eyes it = eyes(room(3.0, 2.0));
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_TRUE(truth);
  EXPECT_NEAR(truth->seeable_m2, 6.0, 1e-9);
  // The centres of 56 x 36 cells of 5 cm are no nearer to a wall than the radius of 0.105 m.
  EXPECT_NEAR(truth->reachable_m2, 56 * 36 * 0.0025, 1e-9);
  EXPECT_FALSE(truth->leaks);
}

TEST(ExplorationReference, WhatLiesBehindANarrowGapIsTold) {
  World world = room(4.0, 2.0);  // a wall across at 2 m, with a gap of 10 cm, less than the robot
  world.solids.push_back(block({2.0, 0.0}, {2.1, 0.95}));
  world.solids.push_back(block({2.0, 1.05}, {2.1, 2.0}));
  const Eyes it = eyes(world);
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_TRUE(truth);
  const auto at = [&](Vec2 p) { return truth->places[truth->places.frame.cell_at(p)]; };
  EXPECT_EQ(at({1.0, 1.0}), reachable);
  EXPECT_EQ(at({0.03, 1.0}), beside_surface);
  EXPECT_EQ(at({0.08, 1.0}), only_seeable);
  EXPECT_EQ(at({3.0, 1.0}), behind_gap) << "straight through the gap";
  EXPECT_EQ(at({2.15, 1.9}), not_seeable) << "behind the wall";
  EXPECT_GT(truth->seeable_m2, 4.0);
  EXPECT_LT(truth->seeable_m2, 8.0);
}

TEST(ExplorationReference, AGapIsOneThatLeavesLessRoomThanWanted) {
  World world = room(4.0, 2.0);  // a wall across with a gap of 25 cm; the robot is 21 cm wide
  world.solids.push_back(block({2.0, 0.0}, {2.1, 0.90}));
  world.solids.push_back(block({2.0, 1.15}, {2.1, 2.0}));
  const Eyes it = eyes(world);
  const auto at = [&](double room_m, Vec2 p) {
    const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0}, room_m);
    return truth->places[truth->places.frame.cell_at(p)];
  };
  EXPECT_EQ(at(0.015, {3.0, 1.0}), reachable);
  EXPECT_EQ(at(0.03, {3.0, 1.0}), behind_gap);
  EXPECT_EQ(at(0.03, {1.5, 0.15}), reachable) << "beside a wall there is less room, too";
}

TEST(ExplorationReference, AnOpenDoorLeaks) {
  World world = room(3.0, 2.0);
  world.solids.back() = block({3.0, 0.5}, {3.1, 2.0});
  const Eyes it = eyes(world);
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_TRUE(truth);
  EXPECT_TRUE(truth->leaks);
  const Box2 standing{{-wall_m, -wall_m}, {3.0 + wall_m, 2.0 + wall_m}};
  EXPECT_FALSE(standing.contains(truth->leaks_at));
  EXPECT_NEAR(truth->leaks_at.x, 3.1, 0.1) << "at the door";
  EXPECT_NEAR(truth->leaks_at.y, 0.25, 0.25);
  EXPECT_LT(distance(truth->standing.low, standing.low), 1e-9);
}

TEST(ExplorationReference, AStartInAWallIsRefusedWithAPlaceThatFits) {
  const Eyes it = eyes(room(3.0, 2.0));
  const auto truth = exploration_reference(it.laser, it.ground, {0.05, 1.0});
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().code, FaultCode::start_blocked);
  EXPECT_EQ(
      to_string(truth.error()),
      "start: at 0.05,1 the robot reaches 0.055 m into what stands there; the nearest place where it fits "
      "is 0.125,1.025");
}

TEST(ExplorationReference, AStartFromWhichNothingCanBeSeenIsRefused) {
  const Eyes it = eyes(room(3.0, 2.0));
  const auto truth = exploration_reference(it.laser, it.ground, {50.0, 1.0});
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().code, FaultCode::start_blocked);
  EXPECT_EQ(
      to_string(truth.error()),
      "start: (50, 1) is outside the map, and nothing is within the 3.5 m that the laser sees: all that "
      "stands lies between (-0.1, -0.1) and (3.1, 2.1); start it in there");
  EXPECT_TRUE(exploration_reference(it.laser, it.ground, {5.0, 1.0})) << "beside the house, in sight of it";
}

TEST(ExplorationReference, AnEmptyWorldIsRefused) {
  const Eyes it = eyes(World{});
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().code, FaultCode::bad_input);
}

TEST(ExplorationReference, AWorldTooLargeIsRefused) {
  World world = room(3.0, 2.0);
  world.solids.push_back(block({1e5, 1e5}, {1e5 + 1, 1e5 + 1}));
  const Eyes it = eyes(world);
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().code, FaultCode::bad_input);
}

/// All pairs of places, and every solid between them.
TEST(ExplorationReference, IsWhatAllPairsOfPlacesSay) {
  Rng rng(11);
  for (int i = 0; i < cases(3); ++i) {
    World world = room(2.0, 1.6);
    for (int k = 0; k < 4; ++k) {
      const Vec2 low{rng.uniform(0.0, 1.8), rng.uniform(0.0, 1.4)};
      world.solids.push_back(block(low, low + Vec2{rng.uniform(0.02, 0.5), rng.uniform(0.02, 0.5)}));
    }
    const double most_m = 1.2;
    const Eyes it = eyes(world, most_m);
    Vec2 start{1.0, 0.8};
    while (it.ground.gap_m(start) < 0.0) start = {rng.uniform(0.2, 1.8), rng.uniform(0.2, 1.4)};
    const double cell_m = 0.08;
    const auto truth = exploration_reference(it.laser, it.ground, start, cell_m);
    ASSERT_TRUE(truth);
    const std::vector<RoundedPolygon> pieces = cut_at(world, 0.18);
    const GridFrame& frame = truth->places.frame;
    int wrong = 0;
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const Vec2 place = frame.centre(frame.cell(c));
      bool seen = false;
      for (std::size_t d = 0; d < frame.size() && !seen; ++d) {
        if (truth->places.cells[d] != reachable) continue;
        const Segment sight{place, frame.centre(frame.cell(d))};
        seen = distance(sight.a, sight.b) <= most_m &&
               std::ranges::all_of(pieces,
                                   [&](const RoundedPolygon& p) { return signed_distance(sight, p) > 0.0; });
      }
      wrong += seen != (truth->places.cells[c] != not_seeable) ? 1 : 0;
    }
    EXPECT_LE(wrong, 4) << "of " << frame.size() << ", where sight is a matter of less than half a degree";
  }
}

TEST(ExplorationReference, MapsAreJudged) {
  const Eyes it = eyes(room(3.0, 2.0));
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_TRUE(truth);
  Grid<std::uint8_t> map({{-0.5, -0.5}, 0.05, 80, 60}, unknown_cell);
  EXPECT_EQ(map_quality(*truth, it.laser, map).explored_fraction, 0.0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Vec2 p = map.frame.centre(map.frame.cell(i));
    if (Box2{{0, 0}, {3, 2}}.contains(p)) map.cells[i] = free_cell;
    if (p.x < 0.0 && p.x > -0.05 && p.y > 0.0 && p.y < 2.0) map.cells[i] = occupied_cell;
  }
  MapQuality quality = map_quality(*truth, it.laser, map);
  EXPECT_EQ(quality.explored_fraction, 1.0);
  EXPECT_NEAR(quality.map_error_m, 0.025, 1e-9) << "half a cell inside the wall";
  EXPECT_NEAR(quality.mapped_free_m2, 6.0, 1e-9);
  EXPECT_EQ(quality.wrongly_free_m2, 0.0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Vec2 p = map.frame.centre(map.frame.cell(i));
    if (p.x > 1.5) map.cells[i] = unknown_cell;
    if (p.x > 3.3 && p.y > 2.3) map.cells[i] = free_cell;
  }
  quality = map_quality(*truth, it.laser, map);
  EXPECT_NEAR(quality.explored_fraction, 0.5, 1e-9);
  EXPECT_NEAR(quality.wrongly_free_m2, 0.2 * 0.2, 1e-9);
}

TEST(ExplorationReference, ATableIsDrivenUnderOnlyWhereItIsHigh) {
  World world = room(3.0, 2.0);
  world.solids.push_back(block({1.5, 0.0}, {3.0, 2.0}, 0.185));  // above the laser, below the robot's top
  const Eyes it = eyes(world);
  const auto truth = exploration_reference(it.laser, it.ground, {1.0, 1.0});
  ASSERT_TRUE(truth);
  EXPECT_NEAR(truth->seeable_m2, 6.0, 1e-9) << "the laser looks under it";
  EXPECT_LT(truth->reachable_m2, 1.5 * 2.0);
}

}  // namespace
}  // namespace outrider
