#include "outrider/path/steering/hybrid_a_star.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/motion/turning_path.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/grid/a_star.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

std::shared_ptr<const GridMap> ground_of(const Grid<std::uint8_t>& grid) {
  return std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::cells));
}

Problem problem_between(const std::shared_ptr<const GridMap>& ground, const Pose2& start, const Pose2& goal) {
  return {ground, start.position, goal.position, nullptr, start.heading_rad, goal.heading_rad};
}

int cusps_of(const Plan& plan) {
  int cusps = 0;
  for (std::size_t i = 1; i < plan.pieces.size(); ++i)
    cusps += plan.pieces[i].backward != plan.pieces[i - 1].backward ? 1 : 0;
  return cusps;
}

/// An empty room of 10 x 10 m.
Grid<std::uint8_t> room() { return Grid<std::uint8_t>(GridFrame{{-5.0, -5.0}, 0.1, 100, 100}); }

void block(Grid<std::uint8_t>& grid, const Box2& box) {
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (box.contains(grid.frame.centre(grid.frame.cell(i)))) grid.cells[i] = 1;
  }
}

TEST(HybridAStar, WithoutObstaclesThePathIsTheShortestOfAll) {
  Rng rng = Rng(1).child("empty");
  const auto ground = ground_of(room());
  Workspace workspace;
  for (int i = 0; i < testing::cases(200); ++i) {
    HybridAStarOptions options;
    options.steering.turning_radius_m = rng.uniform(0.1, 0.8);
    options.steering.reverse = rng.below(2) == 0;
    options.steering.cusp_price_m = 0.0;
    const auto pose = [&] { return Pose2{testing::random_point(rng, 2.5), rng.uniform(-pi, pi)}; };
    const Pose2 start = pose(), goal = pose();
    const Problem problem = problem_between(ground, start, goal);
    const auto plan = hybrid_a_star(problem, options, {}, workspace);
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    ASSERT_TRUE(check(*plan, problem).has_value());
    const double least =
        shortest_turning_length(start, goal, options.steering.turning_radius_m, options.steering.reverse);
    EXPECT_NEAR(plan->cost, least, 2e-6 * std::max(1.0, least))
        << "a path is shortened by a millionth at least";
    EXPECT_NEAR(plan->lower_bound, least, 1e-6);
  }
}

/// Random robots on random grounds: what is found is judged, and what is not found is no claim.
TEST(HybridAStar, AnswersOfRandomRobotsAreLawful) {
  Rng rng = Rng(2).child("robots");
  Workspace workspace;
  int found = 0, missed = 0, impossible = 0;
  for (int i = 0; i < testing::cases(25); ++i) {
    Grid<std::uint8_t> grid = room();
    for (int k = 0; k < 12; ++k) {
      const Vec2 low = testing::random_point(rng, 5.0);
      block(grid, {low, low + Vec2{rng.uniform(0.2, 2.0), rng.uniform(0.2, 2.0)}});
    }
    const auto ground = ground_of(grid);
    HybridAStarOptions options;
    options.steering.turning_radius_m = rng.uniform(0.2, 1.0);
    options.steering.reverse = rng.below(3) != 0;
    options.steering.backward_price = rng.uniform(1.0, 3.0);
    options.most_states = 100'000;
    Problem problem{ground, testing::random_point(rng, 4.9), testing::random_point(rng, 4.9)};
    if (rng.below(3) != 0) problem.outline = testing::random_outline(rng, rng.uniform(0.1, 0.6));
    if (rng.below(3) != 0) problem.start_heading_rad = rng.uniform(-pi, pi);
    if (rng.below(3) != 0) problem.goal_heading_rad = rng.uniform(-pi, pi);
    const auto plan = hybrid_a_star(problem, options, {}, workspace);
    if (!plan) {
      impossible += plan.error().code == FaultCode::no_path ? 1 : 0;
      missed += plan.error().code == FaultCode::budget_exhausted ? 1 : 0;
      if (plan.error().code == FaultCode::no_path) {
        EXPECT_EQ(a_star(problem, {}, {}, workspace).error().code, FaultCode::no_path) << "case " << i;
      }
      continue;
    }
    ++found;
    const auto verdict = check(*plan, problem);
    ASSERT_TRUE(verdict.has_value()) << "case " << i << ": " << to_string(verdict.error());
    EXPECT_EQ(plan->steering, steering_of(options.steering));
    EXPECT_EQ(plan->weights, weights_of(options.steering));
    if (!options.steering.reverse) {
      EXPECT_TRUE(std::ranges::none_of(plan->pieces, &PathPiece::backward));
    }
  }
  EXPECT_GT(found, testing::cases(8));
  EXPECT_LT(missed, found);
  EXPECT_GE(impossible, 0);
}

/// A street with two parked cars and a gap between them that is 0.65 m longer than the robot.
TEST(HybridAStar, ParksBetweenTwoCarsBackwards) {
  Grid<std::uint8_t> grid(GridFrame{{}, 0.05, 160, 60});
  block(grid, {{0.0, 0.0}, {2.5, 0.8}});
  block(grid, {{4.1, 0.0}, {8.0, 0.8}});
  const auto ground = ground_of(grid);
  Problem problem = problem_between(ground, {{1.0, 1.5}, 0.0}, {{2.8, 0.4}, 0.0});
  problem.outline = {{-0.15, -0.25}, {0.8, -0.25}, {0.8, 0.25}, {-0.15, 0.25}};
  HybridAStarOptions options;
  options.steering.turning_radius_m = 0.8;
  Workspace workspace;
  const auto plan = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
  EXPECT_TRUE(check(*plan, problem).has_value());
  EXPECT_GE(cusps_of(*plan), 1);
  EXPECT_TRUE(std::ranges::any_of(plan->pieces, &PathPiece::backward));
  options.steering.reverse = false;
  const auto forwards = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_FALSE(forwards.has_value());
  EXPECT_EQ(forwards.error().code, FaultCode::budget_exhausted) << "a point gets there, so nothing is proven";
}

TEST(HybridAStar, CuspsAreFewerWhereTheyAreDear) {
  const auto ground = ground_of(room());
  const Problem problem = problem_between(ground, {{0.0, 0.0}, 0.0}, {{0.0, 0.6}, pi});
  HybridAStarOptions options;
  options.steering.turning_radius_m = 0.5;
  options.steering.cusp_price_m = 0.0;
  Workspace workspace;
  const auto cheap = hybrid_a_star(problem, options, {}, workspace);
  options.steering.cusp_price_m = 20.0;
  const auto dear = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_TRUE(cheap && dear);
  EXPECT_TRUE(check(*cheap, problem) && check(*dear, problem));
  EXPECT_GT(cusps_of(*cheap), 0);
  EXPECT_EQ(cusps_of(*dear), 0);
  EXPECT_GT(length_of(*dear), length_of(*cheap));
}

/// A corner of two corridors 0.3 m wide: a robot that reaches 1 m ahead cannot swing round it.
TEST(HybridAStar, ALongRobotDoesNotPassWhereAShortOneDoes) {
  Grid<std::uint8_t> grid(GridFrame{{}, 0.05, 80, 80});
  block(grid, {{0.0, 0.0}, {4.0, 4.0}});
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Vec2 p = grid.frame.centre(grid.frame.cell(i));
    const bool along = p.y > 1.0 && p.y < 1.3 && p.x > 0.2 && p.x < 3.0;
    const bool up = p.x > 2.7 && p.x < 3.0 && p.y > 1.0 && p.y < 3.8;
    if (along || up) grid.cells[i] = 0;
  }
  const auto ground = ground_of(grid);
  Problem problem = problem_between(ground, {{0.5, 1.15}, 0.0}, {{2.85, 2.5}, 0.5 * pi});
  HybridAStarOptions options;
  options.steering.turning_radius_m = 0.3;
  Workspace workspace;
  const auto small = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_TRUE(small.has_value()) << small.error().sentence;
  EXPECT_TRUE(check(*small, problem).has_value());
  problem.outline = {{-0.02, -0.02}, {1.0, -0.02}, {1.0, 0.02}, {-0.02, 0.02}};
  const auto large = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_FALSE(large.has_value());
  EXPECT_EQ(large.error().code, FaultCode::budget_exhausted);
  EXPECT_TRUE(a_star(problem, {}, {}, workspace).has_value()) << "the premise";
}

/// A door 0.8 m wide in a wall: a robot of 0.7 x 1.5 m fits through it, and one of 0.9 m does not.
TEST(HybridAStar, TheOutlineItselfPassesADoor) {
  Grid<std::uint8_t> grid = room();
  block(grid, {{-0.1, -5.0}, {0.1, -0.4}});
  block(grid, {{-0.1, 0.4}, {0.1, 5.0}});
  Problem problem = problem_between(ground_of(grid), {{-3.0, -2.0}, 0.0}, {{3.0, 2.0}, 0.0});
  problem.outline = {{-0.4, -0.35}, {1.1, -0.35}, {1.1, 0.35}, {-0.4, 0.35}};
  Workspace workspace;
  const auto through = hybrid_a_star(problem, {}, {}, workspace);
  ASSERT_TRUE(through.has_value()) << through.error().sentence;
  EXPECT_TRUE(check(*through, problem).has_value());
  for (Vec2& corner : problem.outline) corner.y *= 0.45 / 0.35;
  EXPECT_FALSE(check(*through, problem).has_value()) << "the judge knows the outline";
  HybridAStarOptions options;
  options.most_states = 20'000;
  const auto wide = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_FALSE(wide.has_value());
  EXPECT_NE(wide.error().code, FaultCode::start_blocked);
  problem.outline = {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}};
  const auto disk = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_FALSE(disk.has_value());
  EXPECT_EQ(disk.error().code, FaultCode::no_path);
  EXPECT_NE(disk.error().sentence.find("largest disk in the robot"), std::string::npos)
      << "a point gets there";
}

TEST(HybridAStar, HeadingsThatAreNotGivenAreFree) {
  const auto ground = ground_of(room());
  Workspace workspace;
  const Problem any{ground, {-2.0, 0.0}, {2.0, 1.0}};
  const auto plan = hybrid_a_star(any, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  EXPECT_TRUE(check(*plan, any).has_value());
  EXPECT_LE(plan->cost, 1.02 * distance(any.start, any.goal));
  Problem turned = any;
  turned.goal_heading_rad = pi;
  const auto about = hybrid_a_star(turned, {}, {}, workspace);
  ASSERT_TRUE(about.has_value());
  EXPECT_TRUE(check(*about, turned).has_value());
  EXPECT_TRUE(check(*about, any).has_value());
  EXPECT_FALSE(check(*plan, turned).has_value());
}

TEST(HybridAStar, HeadingsMayBeOptions) {
  const auto ground = ground_of(room());
  Workspace workspace;
  const Problem points{ground, {-2.0, 0.0}, {2.0, 1.0}};
  HybridAStarOptions options;
  options.steering.start_heading = "90";
  options.steering.goal_heading = "-45";
  const Problem poses = problem_between(ground, {{-2.0, 0.0}, 0.5 * pi}, {{2.0, 1.0}, -0.25 * pi});
  const auto by_options = hybrid_a_star(points, options, {}, workspace);
  const auto by_problem = hybrid_a_star(poses, {}, {}, workspace);
  ASSERT_TRUE(by_options && by_problem);
  EXPECT_EQ(*by_options, *by_problem);
  options.steering.goal_heading = "north";
  EXPECT_EQ(hybrid_a_star(points, options, {}, workspace).error().where, "goal_heading");
  EXPECT_EQ(*hybrid_a_star(poses, options, {}, workspace), *by_problem) << "the problem has headings";
}

TEST(HybridAStar, RefusesWhatMakesNoQuestion) {
  const auto ground = ground_of(room());
  Workspace workspace;
  Problem problem = problem_between(ground, {{0.0, 0.0}, 0.0}, {{1.0, 1.0}, 0.0});
  const auto where = [&](const HybridAStarOptions& options) {
    const auto plan = hybrid_a_star(problem, options, {}, workspace);
    EXPECT_FALSE(plan.has_value());
    return plan ? std::string() : plan.error().where;
  };
  HybridAStarOptions options;
  options.steering.turning_radius_m = 0.0;
  EXPECT_EQ(where(options), "turning_radius");
  options = {};
  options.headings = 1'000'000;
  EXPECT_EQ(where(options), "headings");
  options = {};
  options.cell_m = 1e-9;
  EXPECT_EQ(where(options), "cell");
  options = {};
  problem.outline = {{0.1, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {0.1, 0.1}};
  EXPECT_EQ(where(options), "footprint") << "its origin is outside";
  problem.outline.clear();
  problem.goal_heading_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(hybrid_a_star(problem, {}, {}, workspace).has_value());
  problem.goal_heading_rad = 0.0;
  problem.goal = {4.95, 0.0};
  options = {};
  problem.outline = {{-0.1, -0.1}, {0.5, -0.1}, {0.5, 0.1}, {-0.1, 0.1}};
  const auto outside = hybrid_a_star(problem, options, {}, workspace);
  problem.outline.clear();
  ASSERT_FALSE(outside.has_value());
  EXPECT_EQ(outside.error().code, FaultCode::goal_blocked);
  options = {};
  options.most_states = 100;
  options.cell_m = 0.02;
  problem.goal = {-1.0, 0.0};
  options.steering.reverse = false;
  Grid<std::uint8_t> maze = room();
  block(maze, {{-0.5, -5.0}, {-0.3, 4.0}});
  problem.grid = ground_of(maze);
  const auto full = hybrid_a_star(problem, options, {}, workspace);
  ASSERT_FALSE(full.has_value());
  EXPECT_EQ(full.error().code, FaultCode::budget_exhausted);
  EXPECT_NE(full.error().sentence.find("most_states"), std::string::npos) << full.error().sentence;
}

}  // namespace
}  // namespace outrider
