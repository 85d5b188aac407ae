#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_worlds.hpp"
#include "research/path/sampling.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr std::string_view names[] = {"prm_star", "rrt_star", "bit_star"};

ConfiguredPlanner planner_of(std::string_view name, const std::string& iterations, const std::string& seed) {
  [[maybe_unused]] static const bool once = (add_sampling_planners(), true);
  ConfiguredPlanner planner = find_path_planner(name)->configure();
  for (const Option& option : planner.options) {
    EXPECT_TRUE(assign(option, option.name == "seed" ? seed : iterations).has_value());
  }
  return planner;
}

std::shared_ptr<const PolygonGround> ground_of(const testing::PolygonWorld& world) {
  return std::make_shared<const PolygonGround>(
      *PolygonGround::of(world.boundary, world.obstacles, world.radius_m));
}

/// A wall from the left with one way round its end.
Problem round_a_wall() {
  testing::PolygonWorld world{{{0, 0}, {8, 0}, {8, 6}, {0, 6}}, {{{0, 2.8}, {6, 2.8}, {6, 3.2}, {0, 3.2}}}};
  return {nullptr, {1, 1}, {1, 5}, ground_of(world)};
}

TEST(Sampling, PathsAreFreeAndNeverShorterThanTheShortest) {
  Rng rng = Rng(31).child("sampling");
  Workspace workspace;
  int found = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const testing::PolygonWorld world = testing::random_world(rng);
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground_of(world)};
    const auto exact = visibility_graph_implicit(problem, {}, {}, workspace);
    for (const std::string_view name : names) {
      const auto answer = planner_of(name, "300", "1").plan(problem, {}, workspace);
      if (!answer) {
        const bool none = exact || exact.error().code == FaultCode::no_path;
        EXPECT_EQ(answer.error().code, none ? FaultCode::budget_exhausted : exact.error().code) << name;
        continue;
      }
      ++found;
      ASSERT_TRUE(exact.has_value()) << name << ", world " << i;
      const auto verdict = check(*answer, problem);
      EXPECT_TRUE(verdict.has_value()) << name << ", world " << i << ": " << verdict.error().sentence;
      EXPECT_GE(answer->cost, exact->cost - 1e-6) << name << ", world " << i;
    }
  }
  EXPECT_GT(found, 30);
}

TEST(Sampling, MorePointsMakeThePathShorter) {
  const Problem problem = round_a_wall();
  Workspace workspace;
  const double least = visibility_graph(problem, {}, {}, workspace)->cost;
  for (const std::string_view name : names) {
    const auto few = planner_of(name, "400", "1").plan(problem, {}, workspace);
    const auto many = planner_of(name, "4000", "1").plan(problem, {}, workspace);
    ASSERT_TRUE(few.has_value() && many.has_value()) << name;
    EXPECT_LT(many->cost, few->cost) << name;
    EXPECT_LT(many->cost, 1.05 * least) << name;
    EXPECT_EQ(many->lower_bound, 4.0) << name;
  }
}

TEST(Sampling, TheSeedAloneTellsThePathInAnyThread) {
  const Problem problem = round_a_wall();
  for (const std::string_view name : names) {
    std::vector<Outcome<Plan>> answers(6, bad_input("not asked"));
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      threads.emplace_back([&, i] {
        Workspace workspace;
        answers[i] = planner_of(name, "500", i % 2 == 0 ? "1" : "2").plan(problem, {}, workspace);
      });
    }
    threads.clear();
    for (const auto& answer : answers) ASSERT_TRUE(answer.has_value()) << name;
    for (std::size_t i = 2; i < answers.size(); ++i) EXPECT_EQ(*answers[i], *answers[i % 2]) << name;
    EXPECT_NE(*answers[0], *answers[1]) << name;
  }
}

TEST(Sampling, WithoutAPathTheFaultSaysThatNothingIsProven) {
  Problem problem = round_a_wall();
  testing::PolygonWorld world{{{0, 0}, {8, 0}, {8, 6}, {0, 6}}, {{{0, 2.8}, {8, 2.8}, {8, 3.2}, {0, 3.2}}}};
  problem.polygons = ground_of(world);
  Workspace workspace;
  for (const std::string_view name : names) {
    const auto answer = planner_of(name, "200", "1").plan(problem, {}, workspace);
    ASSERT_FALSE(answer.has_value()) << name;
    EXPECT_EQ(answer.error().code, FaultCode::budget_exhausted);
    EXPECT_NE(answer.error().sentence.find("does not prove"), std::string::npos) << answer.error().sentence;
  }
}

/// Each leg of the tree is free, and as long as it says.
void expect_a_tree(const Trace& trace, const PolygonGround& ground) {
  EXPECT_TRUE(trace.openings.empty());
  ASSERT_EQ(trace.places.size(), trace.expansions.size());
  const auto place = [&](std::uint32_t state) { return Vec2{trace.places[state].x, trace.places[state].y}; };
  for (std::uint32_t i = 0; i < trace.expansions.size(); ++i) {
    const Expansion& node = trace.expansions[i];
    EXPECT_EQ(node.state, i);
    EXPECT_EQ(node.parent == i, node.g == 0.0);
    EXPECT_TRUE(ground.segment_free({place(node.parent), place(i)}));
    EXPECT_NEAR(node.g, trace.expansions[node.parent].g + distance(place(node.parent), place(i)), 1e-9);
    EXPECT_NEAR(node.f, node.g + node.h, 1e-9);
  }
}

TEST(Sampling, TheTraceIsATree) {
  const Problem problem = round_a_wall();
  for (const std::string_view name : names) {
    SCOPED_TRACE(name);
    Workspace workspace;
    Trace trace;
    workspace.trace = &trace;
    const ConfiguredPlanner planner = planner_of(name, "500", "1");
    const auto plan = planner.plan(problem, {}, workspace);
    ASSERT_TRUE(plan.has_value());
    Workspace untraced;
    EXPECT_EQ(*plan, *planner.plan(problem, {}, untraced));
    expect_a_tree(trace, *problem.polygons);
  }
}

}  // namespace
}  // namespace outrider
