// The tracker tells who moves from what stands, also for a robot that moves itself.
#include "outrider/navigate/moving_things.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "outrider/core/units.hpp"
#include "outrider/sim/sensors/range_finder.hpp"

namespace outrider {
namespace {

constexpr double period_s = 0.1;

RoundedPolygon disk_at(Vec2 place, double radius_m) { return {{place}, radius_m}; }

RoundedPolygon crate_at(Vec2 middle, Vec2 size) {
  const Vec2 half = 0.5 * size;
  return {{middle - half, middle + Vec2{half.x, -half.y}, middle + half, middle + Vec2{-half.x, half.y}},
          0.0};
}

/// The things that move at the end of a scene, and how often anything moved.
struct Told {
  std::vector<MovingThing> moving;
  int times = 0;  ///< scans after which anything moved
};

Told follow(const std::function<std::vector<RoundedPolygon>(double)>& scene,
            const std::function<Pose2(double)>& laser, double end_s) {
  RangeFinderModel model;
  model.most_m = 8.0;
  MovingThings things;
  Rng rng(7);
  Told told;
  for (double t = 0.0; t < end_s; t += period_s) {
    const LaserScan scan = RangeFinder(scene(t), model).look(laser(t), t, rng);
    things.note(scan, laser(t));
    told.moving = things.at(t);
    told.times += told.moving.empty() ? 0 : 1;
  }
  return told;
}

const std::function<Pose2(double)> rests = [](double) { return Pose2{}; };

std::vector<RoundedPolygon> room() {
  return {crate_at({0.0, 4.0}, {10.0, 0.2}), crate_at({0.0, -4.0}, {10.0, 0.2}),
          crate_at({5.0, 0.0}, {0.2, 8.0}),  crate_at({-5.0, 0.0}, {0.2, 8.0}),
          crate_at({2.5, -2.0}, {0.5, 0.4}), disk_at({-2.0, 2.0}, 0.15)};
}

TEST(MovingThings, AWalkerHasItsPlaceAndVelocity) {
  const auto scene = [](double t) {
    auto things = room();
    things.push_back(disk_at({-3.0 + 0.8 * t, 1.2}, 0.2));
    return things;
  };
  const Told told = follow(scene, rests, 4.0);
  ASSERT_EQ(told.moving.size(), 1U);
  const MovingThing& walker = told.moving.front();
  EXPECT_NEAR(walker.place.x, -3.0 + 0.8 * 3.9, 0.25);
  EXPECT_NEAR(walker.place.y, 1.2, 0.25);
  EXPECT_NEAR(walker.velocity.x, 0.8, 0.25);
  EXPECT_NEAR(walker.velocity.y, 0.0, 0.25);
  EXPECT_NEAR(walker.radius_m, 0.2, 0.1);
  EXPECT_GT(told.times, 25);
}

TEST(MovingThings, WhatStandsDoesNotMoveForARobotThatDrives) {
  const auto drives = [](double t) {
    return Pose2{{-3.0 + 0.8 * t, 0.6 * std::sin(t)}, 0.5 * std::sin(2.0 * t)};
  };
  EXPECT_EQ(follow([](double) { return room(); }, drives, 8.0).times, 0);
}

TEST(MovingThings, NothingIsKnownWhereTheLaserDoesNotLook) {
  MovingThings things;
  for (int i = 0; i < 30; ++i) {
    LaserScan scan{0.1 * i, -0.75 * pi, 1.5 * pi / 270, 0.1, 10.0, {}};
    scan.ranges_m.assign(270, 9.0F);
    const double bearing = -0.7 * pi + 0.04 * i;  // a walker comes into view from behind
    for (int beam = 0; beam < 270; ++beam) {
      if (std::abs(scan.first_rad + scan.step_rad * beam - bearing) < 0.1)
        scan.ranges_m[static_cast<std::size_t>(beam)] = 2.0F;
    }
    things.note(scan, {});
  }
  ASSERT_EQ(things.at(2.9).size(), 1U);
  const auto before = things.at(2.9).front().place;
  LaserScan again{1.0, -0.75 * pi, 1.5 * pi / 270, 0.1, 10.0, {}};  // the clock was put back
  again.ranges_m.assign(270, 9.0F);
  things.note(again, {});
  EXPECT_TRUE(things.at(1.0).empty());
  EXPECT_NEAR(norm(before), 2.0, 0.2);
}

TEST(MovingThings, WhoStopsDoesNotMoveAnyMore) {
  const auto scene = [](double t) {
    auto things = room();
    things.push_back(disk_at({2.0, -3.0 + 0.8 * std::min(t, 3.0)}, 0.2));
    return things;
  };
  EXPECT_EQ(follow(scene, rests, 2.9).moving.size(), 1U);
  EXPECT_TRUE(follow(scene, rests, 5.0).moving.empty());
}

TEST(MovingThings, WhatCameLatelyCountsAlthoughItStands) {
  const auto scene = [](double t) {
    auto things = room();
    if (t > 2.95) things.push_back(disk_at({2.0, 1.0}, 0.2));
    return things;
  };
  const Told told = follow(scene, rests, 3.45);
  ASSERT_EQ(told.moving.size(), 1U);
  EXPECT_EQ(norm(told.moving.front().velocity), 0.0);
  EXPECT_LT(distance(told.moving.front().place, Vec2{2.0, 1.0}), 0.25);
  EXPECT_TRUE(follow(scene, rests, 6.0).moving.empty());
}

TEST(MovingThings, WhoTurnsBackIsToldAtOnce) {
  constexpr double turns_s = 2.95;
  const auto scene = [](double t) {
    auto things = room();
    things.push_back(disk_at({2.0, -2.0 + 1.2 * (t < turns_s ? t : 2.0 * turns_s - t)}, 0.2));
    return things;
  };
  const Told told = follow(scene, rests, turns_s + 3.0 * period_s);
  ASSERT_EQ(told.moving.size(), 1U);
  EXPECT_LT(told.moving.front().velocity.y, -0.6);
}

TEST(MovingThings, WhoWalksBehindTheRobotIsFollowedForAWhile) {
  RangeFinderModel model;
  model.view_rad = radians(270.0);
  MovingThings things;
  Rng rng(7);
  const auto walker = [](double t) { return Vec2{2.0 - 0.8 * t, 1.2}; };  // out of sight after 4 s
  for (double t = 0.0; t < 7.0; t += period_s) {
    auto scene = room();
    scene.push_back(disk_at(walker(t), 0.2));
    things.note(RangeFinder(scene, model).look({}, t, rng), {});
    const auto moving = things.at(t);
    if (t > 2.0 && t < 5.0) {
      ASSERT_EQ(moving.size(), 1U) << t;
      EXPECT_LT(distance(moving.front().place, walker(t)), 0.4) << t;
    }
    EXPECT_TRUE(t <= 6.5 || moving.empty()) << t;
  }
}

TEST(MovingThings, TwoWhoMeetAreTwoAgain) {
  const auto scene = [](double t) {
    return std::vector{disk_at({2.0, -3.0 + 1.0 * t}, 0.2), disk_at({3.2, 3.0 - 1.0 * t}, 0.2)};
  };
  const Told told = follow(scene, rests, 5.0);
  ASSERT_EQ(told.moving.size(), 2U);
  EXPECT_LT(told.moving[0].velocity.y * told.moving[1].velocity.y, 0.0);
}

TEST(MovingThings, ASlowWalkerIsTold) {
  const auto scene = [](double t) {
    auto things = room();
    things.push_back(disk_at({2.0, -1.5 + 0.4 * t}, 0.2));
    return things;
  };
  const Told told = follow(scene, rests, 5.0);
  ASSERT_EQ(told.moving.size(), 1U);
  EXPECT_NEAR(told.moving.front().velocity.y, 0.4, 0.25);
  EXPECT_GT(told.times, 35);
}

/// Beams see a walker so near to a wall and the wall as one thing, which is wider than people are.
TEST(MovingThings, WhoWalksAlongAWallIsToldFromIt) {
  const auto walker = [](double t) { return Vec2{-2.0 + 0.8 * t, 3.6}; };
  const auto scene = [&](double t) {
    auto things = room();
    things.push_back(disk_at(walker(t), 0.2));
    return things;
  };
  const Told told = follow(scene, rests, 4.0);
  ASSERT_EQ(told.moving.size(), 1U);
  EXPECT_LT(distance(told.moving.front().place, walker(3.9)), 0.3);
  EXPECT_NEAR(told.moving.front().velocity.x, 0.8, 0.3);
  EXPECT_GT(told.times, 20);
}

TEST(MovingThings, TwoWhoMeetAndTouchAreStillTwo) {
  const auto scene = [](double t) {
    auto things = room();
    things.push_back(disk_at({2.0, -2.0 + 0.8 * t}, 0.2));
    things.push_back(disk_at({2.3, 2.0 - 0.8 * t}, 0.2));  // they touch at 2.5 s
    return things;
  };
  for (const double end_s : {2.1, 2.4, 2.7, 3.3}) {
    const Told told = follow(scene, rests, end_s);
    EXPECT_EQ(told.moving.size(), 2U) << end_s;
  }
}

TEST(MovingThings, AThingIsAtLeastAsWideAsItIsSeen) {
  constexpr double grows_s = 2.95;  // before the last scan
  const auto scene = [](double t) {
    auto things = room();
    things.push_back(disk_at({-1.5 + 0.8 * t, 1.2}, t < grows_s ? 0.1 : 0.4));
    return things;
  };
  const Told before = follow(scene, rests, grows_s), after = follow(scene, rests, grows_s + period_s);
  ASSERT_EQ(before.moving.size(), 1U);
  ASSERT_EQ(after.moving.size(), 1U);
  EXPECT_LT(before.moving[0].radius_m, 0.2);
  EXPECT_GT(after.moving[0].radius_m, 0.3);
}

}  // namespace
}  // namespace outrider
