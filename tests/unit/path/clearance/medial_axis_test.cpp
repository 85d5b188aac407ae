#include "outrider/path/clearance/medial_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/path/check.hpp"
#include "outrider/path/clearance/safest.hpp"
#include "outrider/path/clearance/widest.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/safety.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_worlds.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::PolygonWorld;

std::shared_ptr<const PolygonGround> ground_of(const PolygonWorld& world, double radius_m) {
  auto ground = PolygonGround::of(world.boundary, world.obstacles, radius_m);
  EXPECT_TRUE(ground.has_value()) << ground.error().sentence;
  return std::make_shared<const PolygonGround>(std::move(*ground));
}

PolygonWorld box_in_a_room() {
  return {{{0, 0}, {0, 3}, {3, 3}, {3, 0}},
          {{{1.275, 1.325}, {1.725, 1.325}, {1.725, 1.675}, {1.275, 1.675}}},
          0.1};
}

/// The roomiest of some random places.
Vec2 roomy_place(Rng& rng, const PolygonWorld& world) {
  const std::vector<Segment> edges = testing::edges_of(world);
  Vec2 best = testing::random_place(rng, world);
  for (std::uint64_t k = rng.below(12); k > 0; --k) {
    const Vec2 p = testing::random_place(rng, world);
    if (testing::room(world, edges, p) > testing::room(world, edges, best)) best = p;
  }
  return best;
}

/// Returns true if a disk of that radius gets from start to goal, by a planner that knows no medial axis.
bool passes(const PolygonWorld& world, Problem problem, double radius_m) {
  Workspace workspace;
  problem.polygons = ground_of(world, radius_m);
  return visibility_graph_implicit(problem, {}, {}, workspace).has_value();
}

TEST(MedialAxis, KeepsTheLargestClearanceThatAnyDiskPassesWith) {
  Rng rng = Rng(51).child("medial");
  Workspace workspace;
  int joined = 0, parted = 0, narrow = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const Vec2 start = roomy_place(rng, world), goal = roomy_place(rng, world);
    const Problem problem{nullptr, start, goal, ground_of(world, world.radius_m)};
    SCOPED_TRACE(i);
    const auto plan = medial_axis(problem, {}, {}, workspace);
    const auto wide = widest(problem, {}, {}, workspace);
    ASSERT_EQ(plan.has_value(), wide.has_value());
    if (!plan) {
      ASSERT_EQ(plan.error().code, wide.error().code);
      if (plan.error().code != FaultCode::no_path) continue;
      ++parted;
      ASSERT_FALSE(passes(world, problem, world.radius_m + 1e-6));
      continue;
    }
    ++joined;
    for (const Plan& one : {*plan, *wide}) {
      ASSERT_TRUE(check(one, problem)) << check(one, problem).error().sentence;
    }
    if (problem.start == problem.goal) continue;
    const double largest = clearance_m(*wide, *problem.polygons);
    ASSERT_TRUE(passes(world, problem, largest - 1e-6 * largest));
    ASSERT_FALSE(passes(world, problem, largest + 1e-6 * largest));
    narrow += largest < 0.999 * std::min(problem.polygons->edge_distance(problem.start),
                                         problem.polygons->edge_distance(problem.goal))
                  ? 1
                  : 0;
    ASSERT_GE(clearance_m(*plan, *problem.polygons), 0.998999 * largest);
    ASSERT_LE(plan->lower_bound, plan->cost);
  }
  EXPECT_GT(joined, 16);
  EXPECT_GT(narrow, 1);  // where no end of the path is its narrowest place
  EXPECT_GT(parted, 0);
}

/// The grid knows nothing of the axis, and takes paths that leave it: they cost less, but for the moves,
/// which are up to 1.0824 times as long as they could be, and for the cells, which take away up to 0.075 m of
/// the clearance.
TEST(MedialAxis, AgreesWithTheGrid) {
  Rng rng = Rng(52).child("grid");
  Workspace workspace;
  int joined = 0;
  double most = 0.0;
  for (int i = 0; i < testing::cases(15); ++i) {
    PolygonWorld world = testing::scattered_world(rng, 6);
    const auto ground = ground_of(world, 0.001);
    constexpr double resolution = 0.05;
    auto blocked = blocked_for_disk(*ground, {.resolution_m = resolution});
    ASSERT_TRUE(blocked.has_value());
    const auto grid = std::make_shared<const GridMap>(*GridMap::of(*blocked, GridModel::cells));
    const auto centre = [&](Vec2 p) { return grid->frame.centre(grid->frame.cell_at(p)); };
    const Problem on_grid{grid, centre(testing::random_place(rng, world)),
                          centre(testing::random_place(rng, world))};
    const Problem problem{nullptr, on_grid.start, on_grid.goal, ground};
    const auto fine = safest(on_grid, {}, {}, workspace);
    const auto cheap = safest(on_grid, {10.0, 0.8}, {}, workspace);
    if (!fine || on_grid.start == on_grid.goal) continue;
    const auto wide = widest(problem, {}, {}, workspace);
    ASSERT_TRUE(wide.has_value()) << i;
    const double largest = clearance_m(*wide, *ground);
    ASSERT_LE(safety_of(*fine, on_grid).clearance_m, largest + 1e-9) << i;
    ASSERT_GE(safety_of(*fine, on_grid).clearance_m, largest - 1.5 * resolution) << i;
    if (largest < 0.4) continue;
    ++joined;
    const auto along = medial_axis(problem, {}, {}, workspace);
    ASSERT_TRUE(along.has_value()) << i;
    most = std::max(most, cheap->cost / along->cost);
    const auto wider = medial_axis(problem, {10.0, 0.6}, {}, workspace);  // its bound holds for `cheap` too
    ASSERT_TRUE(wider.has_value()) << i;
    ASSERT_LE(wider->lower_bound, cheap->cost * 1.0001) << i;
    ASSERT_LE(cheap->cost, 1.3 * along->cost) << i;
  }
  EXPECT_GT(joined, 3);
  RecordProperty("most", std::to_string(most));
}

TEST(MedialAxis, RunsMidwayWhereThatIsKnown) {
  // A corridor 2 m wide from (0, 0) to (20, 2): straight along its middle, 1 of clearance.
  const PolygonWorld corridor{{{0, 0}, {0, 2}, {20, 2}, {20, 0}}, {}, 0.1};
  Workspace workspace;
  const Problem along{nullptr, {2, 1}, {17, 1}, ground_of(corridor, 0.1)};
  auto plan = medial_axis(along, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->waypoints, (std::vector<Vec2>{along.start, along.goal}));
  EXPECT_NEAR(plan->cost, 15.0 + 10.0 * 15.0, 1e-6);
  EXPECT_NEAR(plan->lower_bound, plan->cost, 1e-6);
  // From a place near the wall it leads away from it, at ln 2 of exposure.
  const Problem aside{nullptr, {10, 0.5}, {10, 1}, ground_of(corridor, 0.1)};
  plan = medial_axis(aside, {}, {}, workspace);
  EXPECT_NEAR(plan->exposure, std::log(2.0), 1e-4);
  EXPECT_NEAR(plan->lower_bound, 0.5 + 10.0 * std::log(2.0), 1e-6);
}

TEST(MedialAxis, TradesClearanceForLength) {
  const PolygonWorld room = box_in_a_room();
  const Problem problem{nullptr, {2.5, 0.5}, {1.0, 2.5}, ground_of(room, room.radius_m)};
  Workspace workspace;
  const auto shortest = visibility_graph(problem, {}, {}, workspace);
  double before = shortest->cost;
  EXPECT_NEAR(widest(problem, {0.0}, {}, workspace)->cost, before, 1e-9);
  for (const double kept : {0.25, 0.5, 0.75, 1.0}) {
    const auto wide = widest(problem, {kept}, {}, workspace);
    EXPECT_GE(wide->cost, before);
    EXPECT_NEAR(clearance_m(*wide, *problem.polygons), std::max(0.1, 0.5 * kept), 1e-6);
    before = wide->cost;
  }
  const auto wide = widest(problem, {}, {}, workspace);
  const auto safe = medial_axis(problem, {}, {}, workspace);
  const double of_shortest = safety_of(*shortest, problem).exposure;
  const double of_wide = safety_of(*wide, problem).exposure;
  EXPECT_LT(safety_of(*safe, problem).exposure, of_wide);
  EXPECT_LT(of_wide, of_shortest);
  EXPECT_LE(safe->waypoints.size(), 12U) << "it bends round the box at the clearance that it must keep";
}

TEST(MedialAxis, RefusesInASentence) {
  const PolygonWorld room = box_in_a_room();
  const Problem problem{nullptr, {2.5, 0.5}, {1.0, 2.5}, ground_of(room, room.radius_m)};
  Workspace workspace;
  EXPECT_EQ(medial_axis(problem, {-1.0, 1.0, 0.0}, {}, workspace).error().where, "weight");
  EXPECT_EQ(medial_axis(problem, {1.0, std::nan(""), 0.0}, {}, workspace).error().where, "kept");
  EXPECT_EQ(widest(problem, {2.0}, {}, workspace).error().where, "kept");
}

TEST(MedialAxis, AWayAsWideAsTheDiskIsClosedAndALittleMoreIsNot) {
  const PolygonWorld corridor{{{0, 0}, {0, 1}, {10, 1}, {10, 0}}, {}, 0.5};
  Workspace workspace;
  Problem problem{nullptr, {2, 0.5}, {8, 0.5}, ground_of(corridor, 0.5)};
  EXPECT_EQ(medial_axis(problem, {}, {}, workspace).error().code, FaultCode::no_path);
  problem.polygons = ground_of(corridor, 0.5 - 1e-6);
  const auto plan = medial_axis(problem, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_TRUE(check(*plan, problem));
  EXPECT_TRUE(check(*widest(problem, {}, {}, workspace), problem));
}

/// A point of a line has two nearest places on the edges. The exception are branches that lead straight away
/// from an edge where it was cut and rounded, and so bends by a step of the lattice.
TEST(MedialAxis, ItsLinesAreMidwayBetweenTwoNearest) {
  Rng rng = Rng(53).child("lines");
  int points = 0, alone = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const auto ground = ground_of(world, world.radius_m);
    for (const auto& line : medial_axis_lines(*ground)) {
      for (const Vec2 p : line) {
        // The nearest points of the edges, of which two must differ in direction at the same distance.
        double least = ground->edge_distance(p);
        if (ground->solid(p) || least < world.radius_m) continue;
        double spread = 0.0;
        std::vector<Vec2> feet;
        for (const Segment& edge : ground->edges) {
          if (distance(p, edge) > least + 1e-6) continue;
          const Vec2 along = edge.b - edge.a;
          feet.push_back(edge.a + std::clamp(dot(p - edge.a, along) / squared_norm(along), 0.0, 1.0) * along);
        }
        for (const Vec2 one : feet) {
          for (const Vec2 other : feet) spread = std::max(spread, distance(one, other));
        }
        alone += spread > 1e-6 ? 0 : 1;
        ++points;
      }
    }
  }
  EXPECT_GT(points, 1000);
  EXPECT_LT(alone, points / 1000);
}

}  // namespace
}  // namespace outrider
