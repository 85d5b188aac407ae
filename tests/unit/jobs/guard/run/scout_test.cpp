#include "outrider/jobs/guard/run/scout.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {
namespace {

/// A room of 4 x 3 m, mapped with cells of 5 cm, nothing known outside.
Grid<std::uint8_t> room_map() {
  Grid<std::uint8_t> map({{-1.0, -1.0}, 0.05, 120, 100}, unknown_cell);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Vec2 p = map.frame.centre(map.frame.cell(i));
    if (p.x > 0 && p.x < 4 && p.y > 0 && p.y < 3) {
      map.cells[i] = free_cell;
    } else if (p.x > -0.05 && p.x < 4.05 && p.y > -0.05 && p.y < 3.05) {
      map.cells[i] = occupied_cell;
    }
  }
  return map;
}

GuardProblem known() {
  GuardProblem problem;
  problem.targets = {{"seen", {1.0, 1.0, 0.0}, {0.3, 0.3, 0.3}},
                     {"unseen", {2.0, 1.0, 0.0}, {0.3, 0.3, 0.3}},
                     {"in the wall", {4.02, 1.0, 0.0}, {0.3, 0.3, 0.3}}};
  return problem;
}

std::optional<SeenTarget> at(Vec2 place) {
  SeenTarget seen;
  seen.add(place, 1.0);
  return seen;
}

TEST(Scout, MakesAWorldOfWhatIsNotFree) {
  const auto map = room_map();
  const auto found =
      found_yard(known(), {}, map, {}, {at({1.1, 1.0}), {}, at({4.02, 1.0})}, {{2.0, 2.0}, 0.0});
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(found->targets, std::vector<std::size_t>{0});
  EXPECT_DOUBLE_EQ(found->problem.targets.front().base.x, 1.1);
  EXPECT_NEAR(found->problem.robot.radius_m, 0.26 + 0.05 + 0.1, 1e-5);
  const CollisionMap ground = CollisionMap::of(found->problem.world, 0.2);
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const Vec2 p{rng.uniform(-0.04, 4.04), rng.uniform(-0.04, 3.04)};
    const bool is_free = p.x > 0 && p.x < 4 && p.y > 0 && p.y < 3;
    EXPECT_EQ(ground.clearance(p, 1.0) > 0.0, is_free) << p.x << ", " << p.y;
  }
}

TEST(Scout, IsFreeWhereTheRobotStood) {
  auto map = room_map();
  map[map.frame.cell_at({2.0, 1.0})] = occupied_cell;  // a speck that it drove over
  map[map.frame.cell_at({3.0, 1.0})] = occupied_cell;
  const auto found = found_yard(known(), {}, map, {{2.1, 1.0}}, {{}, {}, {}}, {{1.0, 2.0}, 0.0});
  ASSERT_TRUE(found);
  const CollisionMap ground = CollisionMap::of(found->problem.world, 0.2);
  EXPECT_GT(ground.clearance({2.0, 1.0}, 1.0), 0.2);
  EXPECT_LT(ground.clearance({3.02, 1.02}, 1.0), 0.0);
}

TEST(Scout, LeavesTheRobotAsWideAsTheStartHasRoom) {
  const auto found = found_yard(known(), {}, room_map(), {}, {{}, {}, {}}, {{0.3, 1.0}, 0.0});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->problem.robot.radius_m, 0.3, 1e-5);
}

TEST(Scout, RefusesAMapWithNothingFree) {
  GuardProblem far = known();
  const Grid<std::uint8_t> map({{0.0, 0.0}, 0.05, 10, 10}, unknown_cell);
  EXPECT_FALSE(found_yard(far, {}, map, {}, {{}, {}, {}}, {{50.0, 50.0}, 0.0}));
}

TEST(Scout, TakesTheMeanOfAllLooks) {
  SeenTarget seen;
  for (const double x : {1.0, 2.0, 6.0}) seen.add({x, -x}, x);
  EXPECT_NEAR(seen.mean.x, 3.0, 1e-12);
  EXPECT_NEAR(seen.mean.y, -3.0, 1e-12);
  EXPECT_EQ(seen.looks, 3);
  EXPECT_EQ(seen.first_s, 1.0);
  EXPECT_EQ(seen.last_s, 6.0);
}

}  // namespace
}  // namespace outrider
