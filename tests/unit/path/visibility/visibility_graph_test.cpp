#include "outrider/path/visibility/visibility_graph.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "outrider/path/check.hpp"
#include "polygon_worlds.hpp"
#include "support/random_cases.hpp"
#include "tangent_oracle.hpp"

namespace outrider {
namespace {

using testing::PolygonWorld;

std::shared_ptr<const PolygonGround> ground_of(const PolygonWorld& world) {
  auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m);
  EXPECT_TRUE(ground.has_value()) << ground.error().sentence;
  return std::make_shared<const PolygonGround>(std::move(*ground));
}

using Planner = Outcome<Plan> (*)(const Problem&, const VisibilityOptions&, const Budget&, Workspace&);
constexpr Planner planners[] = {visibility_graph, visibility_graph_reduced, visibility_graph_implicit};

/// The answers of the three, which have to agree; that of the first.
Outcome<Plan> agreed(const Problem& problem, Workspace& workspace, const std::string& where) {
  std::vector<Outcome<Plan>> answers;
  for (const Planner planner : planners) answers.push_back(planner(problem, {}, {}, workspace));
  for (const Outcome<Plan>& answer : answers) {
    EXPECT_EQ(answer.has_value(), answers[0].has_value()) << where;
    if (!answer && !answers[0]) {
      EXPECT_EQ(answer.error().code, answers[0].error().code) << where;
    }
    if (!answer || !answers[0]) continue;
    EXPECT_NEAR(answer->cost, answers[0]->cost, 1e-9 * std::max(1.0, answer->cost)) << where;
    const auto verdict = check(*answer, problem);
    EXPECT_TRUE(verdict.has_value()) << where << ": " << verdict.error().sentence;
    EXPECT_EQ(answer->lower_bound, answer->cost) << where;
  }
  return answers[0];
}

TEST(VisibilityGraph, TheThreeAgreeOnRandomWorldsAndNoPathIsConfirmed) {
  Rng rng = Rng(3).child("visibility");
  Workspace workspace;
  int joined = 0, parted = 0;
  for (int i = 0; i < testing::cases(500); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const auto ground = ground_of(world);
    for (int k = 0; k < 3; ++k) {
      const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                            ground};
      const auto answer = agreed(problem, workspace, "world " + std::to_string(i));
      if (HasFailure()) return;
      if (answer) {
        ++joined;
      } else if (answer.error().code == FaultCode::no_path && parted < 60) {
        bool joins = true;
        for (double cell = 0.2; joins && cell > 0.005; cell *= 0.5) {
          joins = testing::flood_joins(world, problem.start, problem.goal, cell);
        }
        EXPECT_FALSE(joins) << "world " << i;
        ++parted;
      }
    }
  }
  EXPECT_GT(joined, 170);
  EXPECT_GT(parted, 7);
}

TEST(VisibilityGraph, BruteForceAgreesOnSmallWorlds) {
  Rng rng = Rng(4).child("brute force");
  Workspace workspace;
  int joined = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    const PolygonWorld world =
        rng.below(2) == 0 ? testing::lattice_world(rng, 3, 0.25) : testing::scattered_world(rng, 2);
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground_of(world)};
    if (problem.start == problem.goal) continue;
    const auto answer = visibility_graph_reduced(problem, {}, {}, workspace);
    const double least = testing::TangentOracle{world}.shortest(problem.start, problem.goal);
    ASSERT_EQ(answer.has_value(), least >= 0.0 && std::isfinite(least)) << "world " << i << ": " << least;
    if (!answer) continue;
    ++joined;
    ASSERT_NEAR(answer->cost, least, 1e-6 * std::max(1.0, least)) << "world " << i;
  }
  EXPECT_GT(joined, 40);
}

using Map = std::function<Vec2(Vec2)>;

PolygonWorld mapped(const PolygonWorld& world, const Map& map) {
  PolygonWorld image = world;
  for (Vec2& p : image.boundary) p = map(p);
  for (auto& obstacle : image.obstacles) {
    for (Vec2& p : obstacle) p = map(p);
  }
  return image;
}

TEST(VisibilityGraph, MirroredTurnedAndMovedWorldsCostTheSame) {
  Rng rng = Rng(5).child("symmetry");
  Workspace workspace;
  const double c = std::cos(0.7), s = std::sin(0.7);
  const std::vector<Map> maps = {
      [](Vec2 p) { return Vec2{-p.x, p.y}; }, [](Vec2 p) { return Vec2{-p.y, p.x}; },
      [](Vec2 p) { return Vec2{p.y, p.x}; },
      [=](Vec2 p) { return Vec2{c * p.x - s * p.y + 3.0, s * p.x + c * p.y - 40.0}; }};
  int joined = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const PolygonWorld world = testing::scattered_world(rng, 10);
    const Vec2 start = testing::random_place(rng, world), goal = testing::random_place(rng, world);
    const auto first = visibility_graph(Problem{nullptr, start, goal, ground_of(world)}, {}, {}, workspace);
    if (!first) continue;
    ++joined;
    const auto back = visibility_graph(Problem{nullptr, goal, start, ground_of(world)}, {}, {}, workspace);
    ASSERT_TRUE(back.has_value());
    EXPECT_NEAR(back->cost, first->cost, 1e-9 * std::max(1.0, first->cost)) << "world " << i;
    for (const Map& map : maps) {
      const Problem image{nullptr, map(start), map(goal), ground_of(mapped(world, map))};
      const auto other = agreed(image, workspace, "image of world " + std::to_string(i));
      ASSERT_TRUE(other.has_value()) << "world " << i;
      ASSERT_NEAR(other->cost, first->cost, 1e-8 * std::max(1.0, first->cost)) << "world " << i;
    }
  }
  EXPECT_GT(joined, 60);
}

/// A wall with a slit of the width, from (0, -5) to (0, 5).
PolygonWorld slit(double width, double radius) {
  PolygonWorld world;
  world.boundary = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  world.obstacles = {{{-0.5, -5}, {0.5, -5}, {0.5, 0}, {-0.5, 0}},
                     {{-0.5, width}, {0.5, width}, {0.5, 5}, {-0.5, 5}}};
  world.radius_m = radius;
  return world;
}

TEST(VisibilityGraph, PassesAGapAsWideAsItselfAndNoNarrower) {
  Workspace workspace;
  const double radius = 0.18;
  for (const double missing : {0.0, 1e-6, 1e-3, 0.36}) {
    const PolygonWorld world = slit(2.0 * radius - missing, radius);
    const Problem problem{nullptr, {-3, 0.1}, {3, 0.2}, ground_of(world)};
    const auto answer = agreed(problem, workspace, "slit");
    EXPECT_EQ(answer.has_value(), missing == 0.0) << missing;
    if (!answer) {
      EXPECT_EQ(answer.error().code, FaultCode::no_path);
    } else {
      EXPECT_NEAR(clearance_m(*answer, *problem.polygons), radius, 1e-9);
    }
  }
}

TEST(VisibilityGraph, NothingSqueezesBetweenObstaclesThatTouch) {
  Workspace workspace;
  PolygonWorld world{{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, {}, least_polygon_radius_m};
  world.obstacles = {{{-5, -5}, {0, 0}, {0, -5}}, {{0, 0}, {5, 5}, {0, 5}}};  // one corner in common
  const Problem corner{nullptr, {-2, 2}, {2, -2}, ground_of(world)};
  EXPECT_EQ(agreed(corner, workspace, "corner").error().code, FaultCode::no_path);
  world.obstacles = {{{-5, -1}, {0, -1}, {0, 0}, {-5, 0}}, {{-1, 0}, {5, 0}, {5, 1}, {-1, 1}}};  // an edge
  const Problem edge{nullptr, {-2, 3}, {2, -3}, ground_of(world)};
  EXPECT_EQ(agreed(edge, workspace, "edge").error().code, FaultCode::no_path);
}

TEST(VisibilityGraph, RoundOneCornerTheLengthIsKnown) {
  Workspace workspace;
  PolygonWorld world{{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, {{{-5, -5}, {0, -5}, {0, 0}, {-5, 0}}}, 0.5};
  const Problem problem{nullptr, {-3, 0.5}, {0.5, -3}, ground_of(world)};
  const auto answer = agreed(problem, workspace, "corner");
  ASSERT_TRUE(answer.has_value());
  EXPECT_NEAR(answer->cost, 6.0 + 0.25 * pi, 1e-12);
  ASSERT_EQ(answer->pieces.size(), 3U);
  EXPECT_NEAR(answer->pieces[1].turn_rad, -0.5 * pi, 1e-12);
  EXPECT_NEAR(answer->waypoint_error_m, 0.5 * (1.0 / std::cos(radians(5.0)) - 1.0), 1e-12);
  EXPECT_EQ(answer->waypoints.size(), 11U);
}

TEST(VisibilityGraph, StraightLegsStayFreeAndWithinTheStatedRatio) {
  Rng rng = Rng(6).child("polygonal");
  Workspace workspace;
  int bent = 0;
  for (int i = 0; i < testing::cases(200); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground_of(world)};
    VisibilityOptions options{true, radians(rng.uniform(1.0, 90.0))};
    const auto exact = visibility_graph(problem, {}, {}, workspace);
    const auto straight = visibility_graph(problem, options, {}, workspace);
    ASSERT_EQ(exact.has_value(), straight.has_value());
    if (!exact) continue;
    const auto verdict = check(*straight, problem);
    ASSERT_TRUE(verdict.has_value()) << "world " << i << ": " << verdict.error().sentence;
    EXPECT_EQ(straight->lower_bound, exact->cost);
    const double half = 0.5 * options.arc_step_rad;
    EXPECT_LE(straight->cost, exact->cost * std::tan(half) / half + 1e-9);
    EXPECT_GE(straight->cost, exact->cost - 1e-9);
    if (straight->cost > exact->cost + 1e-9) ++bent;
  }
  EXPECT_GT(bent, 20);
  VisibilityOptions options;
  options.arc_step_rad = 0.0;
  const Problem any{nullptr, {0, 0}, {1, 1}, ground_of(slit(1.0, 0.1))};
  for (const Planner planner : planners) {
    EXPECT_EQ(planner(any, options, {}, workspace).error().code, FaultCode::bad_input);
  }
}

/// Start and goal where arcs of free space begin and end: there the leg to the arc has no length.
TEST(VisibilityGraph, EndsMayTouchCorners) {
  const PolygonWorld world{{{-4.7, 2.0}, {-4.0, -0.6}, {-1.7, -5.3}, {5.5, -1.0}, {2.8, 5.1}},
                           {{{1.226, 1.051}, {0.756, 1.008}, {0.606, 0.529}, {1.154, 0.306}}},
                           0.399};
  const auto ground = ground_of(world);
  std::vector<Vec2> ends;
  for (const FreeArc& arc : ground->arcs) {
    ends.push_back(arc.centre + ground->radius_m * arc.first);
    ends.push_back(arc.centre + ground->radius_m * arc.last);
  }
  Workspace workspace;
  for (const Vec2 start : ends) {
    for (const Vec2 goal : ends) {
      EXPECT_TRUE(agreed({nullptr, start, goal, ground}, workspace, "between ends of arcs").has_value());
    }
  }
}

TEST(VisibilityGraph, SweepAndPairsFindTheSameLegs) {
  Rng rng = Rng(7).child("legs");
  for (int i = 0; i < testing::cases(200); ++i) {
    const auto ground = ground_of(testing::random_world(rng));
    EXPECT_EQ(visibility_legs(*ground, true).size(), visibility_legs(*ground, false).size()) << "world " << i;
  }
}

}  // namespace
}  // namespace outrider
