#include "outrider/path/visibility/polygon_ground.hpp"

#include <gtest/gtest.h>

#include "outrider/path/check.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/grid/theta_star.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_worlds.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::PolygonWorld;

const std::vector<Vec2> room{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};

PolygonGround ground_of(const PolygonWorld& world) {
  auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m);
  EXPECT_TRUE(ground.has_value()) << ground.error().sentence;
  return std::move(*ground);
}

TEST(PolygonGround, BoundsOfASquareAreItsSidesMovedAndFourQuarters) {
  const PolygonGround ground = ground_of({room, {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}, 0.5});
  EXPECT_EQ(ground.arcs.size(), 4U);
  for (const FreeArc& arc : ground.arcs) EXPECT_NEAR(arc.width_rad, 0.5 * pi, 1e-12);
  EXPECT_EQ(ground.walls.size(), 8U);  // four of them inside the room's walls
  for (const Segment& wall : ground.walls) {
    const double length = distance(wall.a, wall.b);
    EXPECT_TRUE(std::abs(length - 2.0) < 1e-12 || std::abs(length - 9.0) < 1e-12) << length;
  }
}

TEST(PolygonGround, FreeMeansTheRadiusAwayFromEverything) {
  Rng rng = Rng(8).child("freedom");
  for (int i = 0; i < testing::cases(150); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const PolygonGround ground = ground_of(world);
    const auto edges = testing::edges_of(world);
    for (int k = 0; k < 40; ++k) {
      const Vec2 p{rng.uniform(-6, 9), rng.uniform(-6, 9)};
      const double room_there = testing::room(world, edges, p);
      if (std::abs(room_there) < 1e-6) continue;
      EXPECT_EQ(ground.solid(p), room_there < 0.0);
      EXPECT_NEAR(ground.edge_distance(p), std::abs(room_there), 1e-12);
      if (std::abs(room_there - world.radius_m) < 1e-6) continue;
      EXPECT_EQ(ground.point_free(p), room_there > world.radius_m);
      const Segment leg{p, testing::random_place(rng, world)};
      double least = 1e300;
      for (const Segment& edge : edges) least = std::min(least, distance(edge, leg));
      if (room_there < world.radius_m || std::abs(least - world.radius_m) < 1e-6) continue;
      EXPECT_EQ(ground.segment_free(leg), least > world.radius_m);
    }
  }
}

TEST(PolygonGround, TheBoundIsFreeAndNothingBeyondIt) {
  Rng rng = Rng(9).child("bound");
  for (int i = 0; i < testing::cases(150); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const PolygonGround ground = ground_of(world);
    const auto edges = testing::edges_of(world);
    const auto on_bound = [&](Vec2 p) {
      EXPECT_NEAR(testing::room(world, edges, p), world.radius_m, 2e-9) << "world " << i;
    };
    for (const FreeArc& arc : ground.arcs) {
      EXPECT_LT(arc.width_rad, pi);
      for (const double part : {0.0, 0.3, 0.5, 1.0}) {
        on_bound(arc.centre + world.radius_m * direction(arc.from_rad + part * arc.width_rad));
      }
    }
    for (const Segment& wall : ground.walls) {
      for (const double part : {0.0, 0.4, 1.0}) on_bound(wall.a + part * (wall.b - wall.a));
    }
  }
}

TEST(PolygonGround, RefusesWhatIsNoGround) {
  const auto sentence = [](const std::vector<Vec2>& boundary, const std::vector<std::vector<Vec2>>& obstacles,
                           double radius) {
    const auto ground = PolygonGround::of(boundary, obstacles, radius);
    EXPECT_FALSE(ground.has_value());
    return ground ? std::string{} : ground.error().sentence;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(sentence(room, {}, 0.0).find("radius of 0 m"), std::string::npos);
  EXPECT_NE(sentence(room, {}, nan).find("radius"), std::string::npos);
  EXPECT_NE(sentence({}, {}, 0.1).find("the boundary has 0 distinct corners"), std::string::npos);
  EXPECT_NE(sentence(room, {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, 0.1).find("obstacle 1 crosses"),
            std::string::npos);
  EXPECT_NE(sentence(room, {{{0, 0}, {nan, 1}, {1, 0}}}, 0.1).find("(nan, 1)"), std::string::npos);
  EXPECT_NE(sentence(room, {std::vector<Vec2>(5000, Vec2{1, 1})}, 0.1).find("5004 corners"),
            std::string::npos);
  // Nearly degenerate, decided without rounding: the third corner lies a hair to one side.
  const double hair = std::nextafter(0.5, 1.0);
  EXPECT_TRUE(check_polygon({{0, 0}, {1, 1}, {0.5, hair}}, "it").has_value());
  EXPECT_FALSE(check_polygon({{0, 0}, {1, 1}, {0.5, 0.5}}, "it").has_value());
}

TEST(PolygonCheck, FindsEachKindOfFault) {
  const PolygonWorld world{room, {{{-5, -5}, {0, -5}, {0, 0}, {-5, 0}}}, 0.5};
  const Problem problem{
      nullptr, {-3, 0.5}, {0.5, -3}, std::make_shared<const PolygonGround>(ground_of(world))};
  Workspace workspace;
  const Plan good = *visibility_graph_reduced(problem, {}, {}, workspace);
  ASSERT_TRUE(check(good, problem).has_value());
  const auto refuses = [&](const char* word, auto change) {
    Plan bad = good;
    change(bad);
    const auto verdict = check(bad, problem);
    ASSERT_FALSE(verdict.has_value()) << word;
    EXPECT_NE(verdict.error().sentence.find(word), std::string::npos) << verdict.error().sentence;
  };
  refuses("comes within", [](Plan& p) {  // straight across the corner
    p.pieces = {{p.pieces.front().from, p.pieces.back().to, {}, 0.0}};
  });
  refuses("comes within", [](Plan& p) {  // round the corner on the wrong side
    PathPiece& arc = p.pieces[1];
    arc.centre = arc.from + arc.to - arc.centre;
    arc.turn_rad = -arc.turn_rad;
  });
  refuses("does not begin where", [](Plan& p) { p.pieces.erase(p.pieces.begin() + 1); });
  refuses("is no arc", [](Plan& p) { p.pieces[1].turn_rad *= 0.9; });
  refuses("end at the goal", [](Plan& p) { p.pieces.pop_back(); });
  refuses("waypoint", [](Plan& p) { p.waypoint_error_m = 0.0; });
  refuses("waypoint", [](Plan& p) { p.waypoints[1].y += 0.01; });
  refuses("cost", [](Plan& p) { p.cost *= 1.0 + 1e-8; });
  refuses("lower bound", [](Plan& p) { p.lower_bound = p.cost + 1.0; });
}

TEST(PolygonGrid, PathsOnTheGridAreFreeAmongThePolygonsAndNoneIsShorter) {
  Rng rng = Rng(10).child("grid");
  Workspace workspace;
  int joined = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const auto polygons = std::make_shared<const PolygonGround>(ground_of(world));
    const auto blocked = blocked_for_disk(*polygons, {.resolution_m = rng.uniform(0.08, 0.3)});
    ASSERT_TRUE(blocked.has_value()) << blocked.error().sentence;
    const auto edges = testing::edges_of(world);
    for (int k = 0; k < 200; ++k) {
      const Vec2 p = testing::random_place(rng, world);
      const auto cell = blocked->frame.cell_at(p);
      const double room_there = testing::room(world, edges, p);
      if ((*blocked)[cell] == 0) {
        EXPECT_GE(room_there, world.radius_m - 2e-9);
      }
      if ((*blocked)[cell] != 0) {
        EXPECT_LE(room_there, world.radius_m + std::sqrt(2.0) * blocked->frame.resolution_m + 1e-9);
      }
    }
    for (const GridModel model : {GridModel::cells, GridModel::corners}) {
      const auto grid = std::make_shared<const GridMap>(*GridMap::of(*blocked, model));
      Problem problem{grid, testing::random_place(rng, world), testing::random_place(rng, world)};
      const auto plan = theta_star(problem, {}, {}, workspace);
      if (!plan) continue;
      ++joined;
      EXPECT_GE(clearance_m(*plan, *polygons), world.radius_m - 2e-9);
      const Problem same{nullptr, plan->waypoints.front(), plan->waypoints.back(), polygons};
      const auto exact = visibility_graph_reduced(same, {}, {}, workspace);
      ASSERT_TRUE(exact.has_value());
      EXPECT_LE(exact->cost, plan->cost + 1e-9);
    }
  }
  EXPECT_GT(joined, 20);
  const PolygonGround small = ground_of({room, {}, 0.5});
  EXPECT_FALSE(blocked_for_disk(small, {.resolution_m = 0.0}).has_value());
  EXPECT_FALSE(blocked_for_disk(small, {.resolution_m = 1e-6}).has_value());
}

}  // namespace
}  // namespace outrider
