#include "outrider/path/check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/path/grid/a_star.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

Problem asked(const Grid<std::uint8_t>& grid, GridModel model, Cell start, Cell goal) {
  auto ground = std::make_shared<const GridMap>(*GridMap::of(grid, model));
  return {ground, ground->point(start), ground->point(goal)};
}

Plan along(const Problem& problem, const std::vector<Cell>& vertices) {
  Plan plan;
  for (const Cell v : vertices) {
    if (!plan.waypoints.empty()) plan.cost += distance(plan.waypoints.back(), problem.grid->point(v));
    plan.vertices.push_back(v);
    plan.waypoints.push_back(problem.grid->point(v));
  }
  plan.lower_bound = distance(problem.start, problem.goal);
  return plan;
}

class JudgeOfBothModels : public testing::TestWithParam<GridModel> {};
INSTANTIATE_TEST_SUITE_P(Models, JudgeOfBothModels, testing::Values(GridModel::cells, GridModel::corners),
                         [](const auto& model) { return std::string(to_string(model.param)); });

/// Every single leg between two places, legal or not, against the definition.
TEST_P(JudgeOfBothModels, JudgesLegsByTheDefinition) {
  Rng rng = Rng(4).child("judge");
  int legal = 0, illegal = 0;
  for (int i = 0; i < 250; ++i) {
    const auto grid = random_grid(rng, 7);
    const int more = GetParam() == GridModel::corners ? 1 : 0;
    for (int k = 0; k < 60; ++k) {
      const auto vertex = [&] {
        return Cell{static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.width + more))),
                    static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.height + more)))};
      };
      const Cell a = vertex(), b = vertex();
      if (a == b || !oracle::place(grid, GetParam(), a) || !oracle::place(grid, GetParam(), b)) continue;
      const Problem problem = asked(grid, GetParam(), a, b);
      const bool expected = oracle::legal(grid, GetParam(), a, b);
      ASSERT_EQ(check(along(problem, {a, b}), problem).has_value(), expected) << "grid " << i;
      ++(expected ? legal : illegal);
    }
  }
  EXPECT_GT(legal, 500);
  EXPECT_GT(illegal, 500);
}

TEST_P(JudgeOfBothModels, RefusesWhatWasTamperedWith) {
  const Problem problem = asked(drawn({".....", "..#..", "..#..", "....."}), GetParam(), {0, 2}, {4, 2});
  Workspace workspace;
  const auto plan = a_star(problem, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value());
  ASSERT_TRUE(check(*plan, problem).has_value());
  const auto refused = [&](auto change) {
    Plan other = *plan;
    change(other);
    return !check(other, problem).has_value();
  };
  EXPECT_FALSE(refused([&](Plan& p) { p = along(problem, {{0, 2}, {0, 0}, {4, 0}, {4, 2}}); }));
  EXPECT_TRUE(refused([](Plan& p) { p.cost += 1e-6; }));
  EXPECT_TRUE(refused([](Plan& p) { p.cost = std::nan(""); }));
  EXPECT_TRUE(refused([](Plan& p) { p.lower_bound = p.cost + 1e-6; }));
  EXPECT_TRUE(refused([](Plan& p) { p.lower_bound = std::nan(""); }));
  EXPECT_TRUE(refused([](Plan& p) { p.reached_within = 0.5; }));
  EXPECT_TRUE(refused([](Plan& p) { p.waypoints.clear(); }));
  EXPECT_TRUE(refused([](Plan& p) { p = {}; }));
  EXPECT_TRUE(refused([](Plan& p) { p.waypoints[1].x += 1e-3; }));
  EXPECT_TRUE(refused([](Plan& p) { p.vertices.pop_back(), p.waypoints.pop_back(); }));
  EXPECT_TRUE(
      refused([](Plan& p) { p.vertices.erase(p.vertices.begin()), p.waypoints.erase(p.waypoints.begin()); }));
  EXPECT_TRUE(refused([&](Plan& p) { p = along(problem, {{0, 2}, {4, 2}}); }));  // through the wall
  EXPECT_TRUE(refused(
      [&](Plan& p) { p = along(problem, {{0, 2}, {0, 2}, {0, 0}, {4, 0}, {4, 2}}); }));  // a leg of no length
  EXPECT_TRUE(refused([&](Plan& p) { p = along(problem, {{0, 2}, {-1, 2}, {0, 0}, {4, 0}, {4, 2}}); }));
}

TEST(Judge, LetsNoPathPassThroughAPinch) {
  const auto grid = drawn({"#.", ".#"});
  const Problem problem = asked(grid, GridModel::corners, {0, 0}, {2, 2});
  EXPECT_FALSE(check(along(problem, {{0, 0}, {2, 2}}), problem).has_value());
  EXPECT_FALSE(check(along(problem, {{0, 0}, {1, 1}, {2, 2}}), problem).has_value());
  const Problem to_pinch = asked(grid, GridModel::corners, {0, 0}, {1, 1});
  EXPECT_TRUE(check(along(to_pinch, {{0, 0}, {1, 1}}), to_pinch).has_value());
}

TEST(AStar, WeightBoundsTheCost) {
  Rng rng = Rng(8).child("weight");
  Workspace workspace;
  for (int i = 0; i < 300; ++i) {
    auto grid = random_grid(rng, 20);
    const Cell goal{grid.frame.width - 1, grid.frame.height - 1};
    grid[{0, 0}] = grid[goal] = 0;
    const Problem problem = asked(grid, GridModel::cells, {0, 0}, goal);
    const auto best = a_star(problem, {}, {}, workspace);
    const auto fast = a_star(problem, {.weight = 2.5}, {}, workspace);
    ASSERT_EQ(best.has_value(), fast.has_value());
    if (!best) continue;
    EXPECT_TRUE(check(*fast, problem).has_value());
    EXPECT_LE(fast->cost, 2.5 * best->cost + 1e-9);
    EXPECT_LE(fast->lower_bound, best->cost + 1e-9);
  }
  for (const double weight : {0.5, -1.0, 1e9, std::nan("")}) {
    const auto answer =
        a_star(asked(drawn({".."}), GridModel::cells, {0, 0}, {1, 0}), {weight}, {}, workspace);
    ASSERT_FALSE(answer.has_value());
    EXPECT_EQ(answer.error().code, FaultCode::bad_input);
  }
}

}  // namespace
}  // namespace outrider
