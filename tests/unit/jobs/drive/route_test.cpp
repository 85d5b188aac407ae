#include "outrider/jobs/drive/route.hpp"

#include <gtest/gtest.h>

#include <pthread.h>

#include <cmath>
#include <functional>

#include "outrider/path/catalog.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// 3 x 3 m with a box of 0.45 x 0.35 m in the middle.
CollisionMap arena() {
  return {{{0, 0}, {3, 3}}, {{{{1.275, 1.325}, {1.725, 1.325}, {1.725, 1.675}, {1.275, 1.675}}, 0.0}}};
}

DriveTask task_at(const Pose2& start) {
  DriveTask task;
  task.start = start;
  task.tags.tags = {upright_tag(1, {3, 1.5, 0.2}, pi), upright_tag(2, {1.5, 3, 0.2}, -pi / 2)};
  return task;
}

double distance_to_way(Vec2 p, const std::vector<Vec2>& way) {
  double least = distance(p, way.front());
  for (std::size_t i = 1; i < way.size(); ++i)
    least = std::min(least, distance(p, Segment{way[i - 1], way[i]}));
  return least;
}

TEST(DriveRoute, EveryPlannerGivesAWayThatCanBeDriven) {
  const CollisionMap ground = arena();
  for (const PathPlanner& planner : path_planners()) {
    DriveTask task = task_at({{0.5, 0.5}, 0.0});
    const auto route = plan_route(task, ground, {{2.5, 2.5}, 1.0}, std::string(planner.name), {});
    if (planner.steers) {  // this robot turns in place
      EXPECT_EQ(route.error().code, FaultCode::bad_input);
      continue;
    }
    ASSERT_TRUE(route) << planner.name << ": " << to_string(route.error());
    task.waypoints = route->waypoints;
    EXPECT_TRUE(check_waypoints(task, ground)) << planner.name;
    EXPECT_LE(task.waypoints.size(), 12U) << planner.name;
    EXPECT_TRUE(task.waypoints.back().stop);
    EXPECT_EQ(task.waypoints.back().pose, (Pose2{{2.5, 2.5}, 1.0}));
    std::vector<Vec2> way = {task.start.position};
    for (const Waypoint& waypoint : task.waypoints) way.push_back(waypoint.pose.position);
    for (std::size_t i = 1; i + 1 < route->plan.waypoints.size(); ++i) {
      EXPECT_LE(distance_to_way(route->plan.waypoints[i], way), 0.02 + 0.05) << planner.name;
    }
  }
}

TEST(DriveRoute, PassesWithTheCameraTowardsATag) {
  const auto route =
      plan_route(task_at({{0.5, 0.6}, 0.0}), arena(), {{2.5, 2.4}, 0.0}, "visibility_graph", {});
  ASSERT_TRUE(route);
  bool faces = false;
  for (const Waypoint& waypoint : route->waypoints) {
    for (const Vec2 tag : {Vec2{3, 1.5}, Vec2{1.5, 3}}) {
      const double bearing = heading_of(tag - waypoint.pose.position);
      faces |= !waypoint.stop && std::abs(wrap_angle(bearing - waypoint.pose.heading_rad)) < 1e-9;
    }
  }
  EXPECT_TRUE(faces);
}

TEST(DriveRoute, ThinningStaysNearAndClear) {
  Rng rng(1);
  const CollisionMap ground = arena();
  for (int round = 0; round < testing::cases(50); ++round) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 60; ++i) {  // about the box
      const double angle = 0.05 * i;
      const double radius = 0.8 + 0.3 * std::sin(0.2 * i) + 0.02 * rng.uniform(-1.0, 1.0);
      points.push_back(Vec2{1.5, 1.5} + radius * direction(angle));
    }
    const auto kept = thinned(points, 0.03, ground, 0.15);
    EXPECT_EQ(kept.front(), points.front());
    EXPECT_EQ(kept.back(), points.back());
    EXPECT_LT(kept.size(), points.size());
    for (const Vec2 p : points) EXPECT_LE(distance_to_way(p, kept), 0.03 + 1e-12);
    for (std::size_t i = 1; i < kept.size(); ++i)
      EXPECT_TRUE(ground.segment_free({kept[i - 1], kept[i]}, 0.15));
  }
}

TEST(DriveRoute, ThinningTakesNoStackForEachPoint) {
  // A zigzag whose amplitude shrinks: the farthest point is always the next one.
  std::vector<Vec2> points;
  for (int i = 0; i < 3000; ++i)
    points.push_back({0.5 + 1e-4 * i, 1.0 + (i % 2 == 0 ? 0.3 : -0.3) * (1.0 - i / 3000.0)});
  std::function<void()> thin = [&] { EXPECT_EQ(thinned(points, 1e-6, arena(), 0.01), points); };
  pthread_attr_t small{};
  pthread_t thread{};
  ASSERT_EQ(pthread_attr_init(&small), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&small, std::size_t{256} << 10), 0);  // 90 bytes for each point
  const auto run = [](void* given) -> void* {
    return (*static_cast<std::function<void()>*>(given))(), nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &small, run, &thin), 0);
  ASSERT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&small);
}

TEST(DriveRoute, ClearanceOfAWayAgainstSamples) {
  Rng rng(2);
  const CollisionMap ground = arena();
  for (int round = 0; round < testing::cases(50); ++round) {
    std::vector<Vec2> way;
    for (int i = 0; i < 3; ++i) way.push_back({rng.uniform(0.1, 2.9), rng.uniform(0.1, 2.9)});
    double sampled = 1e9;
    for (std::size_t i = 1; i < way.size(); ++i) {
      for (int k = 0; k <= 2000; ++k) {
        sampled = std::min(sampled, ground.clearance(way[i - 1] + (k / 2000.0) * (way[i] - way[i - 1]), 3.0));
      }
    }
    const double exact = way_clearance_m(way, ground);
    if (sampled > 0.0) {
      EXPECT_NEAR(exact, sampled, 2e-3);
    } else if (sampled < -2e-3) {
      EXPECT_LT(exact, 1e-9);
    }
  }
}

TEST(DriveRoute, RefusesWhatCannotBeDriven) {
  const CollisionMap ground = arena();
  DriveTask task = task_at({{0.5, 0.5}, 0.0});
  task.waypoints = {{{{1.5, 1.5}, 0.0}}};
  const auto within = check_waypoints(task, ground);
  ASSERT_FALSE(within);
  EXPECT_NE(to_string(within.error()).find("waypoint 1 at 1.5,1.5"), std::string::npos);
  task.waypoints = {{{{2.5, 2.5}, 0.0}}};
  const auto through = check_waypoints(task, ground);
  ASSERT_FALSE(through);
  EXPECT_NE(to_string(through.error()).find("goal and a planner"), std::string::npos);
  EXPECT_FALSE(plan_route(task, ground, {{2.5, 2.5}, 0.0}, "a_starr", {}));
  EXPECT_FALSE(plan_route(task, ground, {{1.5, 1.5}, 0.0}, "a_star", {}));
}

}  // namespace
}  // namespace outrider
