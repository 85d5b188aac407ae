// Explorations under bad conditions: complete, or a reason; never complete with less than was to be seen.
#include <gtest/gtest.h>

#include <string>

#include "box_solid.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "support/costly_cases.hpp"

namespace outrider {
namespace {

World walled_hall(double width_m, double height_m) {
  World world;
  world.solids = {testing::box("south", {-0.2, -0.2}, {width_m + 0.2, 0.0}),
                  testing::box("north", {-0.2, height_m}, {width_m + 0.2, height_m + 0.2}),
                  testing::box("west", {-0.2, 0.0}, {0.0, height_m}),
                  testing::box("east", {width_m, 0.0}, {width_m + 0.2, height_m})};
  world.bounds = {{-0.2, -0.2}, {width_m + 0.2, height_m + 0.2}};
  return world;
}

/// Two rooms with a door and a box in each.
World two_rooms() {
  World world = walled_hall(8.0, 4.0);
  world.solids.push_back(testing::box("below", {3.9, 0.0}, {4.1, 1.4}));
  world.solids.push_back(testing::box("above", {3.9, 2.4}, {4.1, 4.0}));
  world.solids.push_back(testing::box("table", {1.8, 2.6}, {2.4, 3.2}));
  world.solids.push_back(testing::box("chest", {6.0, 0.8}, {6.6, 1.2}));
  return world;
}

/// A room strewn with blocks as large as two cells of the map.
World strewn_room(std::uint64_t seed) {
  World world = walled_hall(7.0, 5.0);
  Rng rng = Rng(seed).child("strewn");
  for (int i = 0; i < 30; ++i) {
    const Vec2 at{rng.uniform(0.3, 6.6), rng.uniform(0.3, 4.6)};
    if (distance(at, Vec2{1.0, 1.0}) < 0.5) continue;
    world.solids.push_back(testing::box("block" + std::to_string(i), at, at + Vec2{0.1, 0.1}));
  }
  return world;
}

ExploreRun explored_in(const World& world, const ExplorerSimParams& params, std::uint64_t seed) {
  ExploreTask task;
  task.start = {{1.0, 1.0}, 0.0};
  task.rules.most_time_s = 400.0;
  Log log;
  auto run = run_explore(world, task, params, seed, log);
  EXPECT_TRUE(run) << run.error().sentence;
  return std::move(*run);
}

/// The robot has seen all that it calls complete; everything else has a reason.
void expect_honest(const ExploreRun& run) {
  if (run.stop_reason == "complete") {
    EXPECT_GT(metric(run.report, "explored_fraction"), 0.98);
    EXPECT_LT(metric(run.report, "map_error_m"), 0.1);
    EXPECT_EQ(metric(run.report, "left_over_m2"), 0.0);
  } else {
    EXPECT_FALSE(run.report.reason.empty());
    EXPECT_EQ(run.report.status, "not_done");
  }
}

TEST(ExploreAdversity, GetsAroundSingleBlocks) {
  for (int n = 1; n <= testing::costly_cases(2); ++n) {
    const auto seed = static_cast<std::uint64_t>(n);
    const ExploreRun run = explored_in(strewn_room(seed), {}, seed);
    expect_honest(run);
    EXPECT_GT(metric(run.report, "explored_fraction"), 0.97) << run.report.reason;
    EXPECT_EQ(metric(run.report, "returned_home"), 1.0) << run.report.reason;
  }
}

TEST(ExploreAdversity, SurvivesThreeBeamsInTenWithoutReading) {
  ExplorerSimParams params;
  params.laser.missed = 0.3;
  const ExploreRun run = explored_in(two_rooms(), params, 1);
  expect_honest(run);
  EXPECT_EQ(run.stop_reason, "complete") << run.report.reason;
}

TEST(ExploreAdversity, IsHonestWithSevenBeamsInTenWithoutReading) {
  ExplorerSimParams params;
  params.laser.missed = 0.7;
  expect_honest(explored_in(walled_hall(4.0, 3.0), params, 1));
}

TEST(ExploreAdversity, SurvivesThreeTimesTheErrorsOfTheWheels) {
  ExplorerSimParams params;
  params.wheels.scale_error *= 3.0;
  params.wheels.noise_m *= 3.0;
  for (int n = 1; n <= testing::costly_cases(1); ++n) {
    const ExploreRun run = explored_in(two_rooms(), params, static_cast<std::uint64_t>(n));
    expect_honest(run);
    EXPECT_EQ(run.stop_reason, "complete") << run.report.reason;
  }
}

TEST(ExploreAdversity, EndsSoonWhereItsMapFallsIntoPieces) {
  ExplorerSimParams params;
  params.laser.missed = 0.37;
  params.wheels.noise_m = 0.24;
  const ExploreRun run = explored_in(two_rooms(), params, 1);
  EXPECT_EQ(run.stop_reason, "lost");
  EXPECT_LT(metric(run.report, "time_s"), 200.0);
}

TEST(ExploreAdversity, IsHonestInAHallWiderThanItSees) {
  expect_honest(explored_in(walled_hall(16.0, 8.0), {}, 1));
}

}  // namespace
}  // namespace outrider
