#include "outrider/path/clearance/safest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "outrider/core/rng.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/safety.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using Blocked = Grid<std::uint8_t>;

Problem problem_on(const Blocked& blocked, Cell start, Cell goal) {
  auto ground = std::make_shared<const GridMap>(*GridMap::of(blocked, GridModel::cells));
  return {ground, ground->point(start), ground->point(goal)};
}

bool blocked_at(const Blocked& grid, int x, int y) { return !grid.contains({x, y}) || grid[{x, y}] != 0; }

/// Returns the clearance by all squares, those around the grid too.
double own_clearance(const Blocked& grid, Vec2 p) {
  double least = 1e300;
  for (int y = -1; y <= grid.frame.height; ++y) {
    for (int x = -1; x <= grid.frame.width; ++x) {
      if (!blocked_at(grid, x, y)) continue;
      const double dx = std::max({0.0, x - p.x, p.x - x - 1.0}), dy = std::max({0.0, y - p.y, p.y - y - 1.0});
      least = std::min(least, std::hypot(dx, dy));
    }
  }
  return least;
}

/// A move with its length, its least clearance by dense sampling, and Simpson's sum of 1 / clearance.
struct Move {
  std::size_t from, to;
  double length, clearance, exposure;
};

std::vector<Move> moves_of(const Blocked& grid) {
  std::vector<Move> moves;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Cell v = grid.frame.cell(i);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || blocked_at(grid, v.x, v.y) || blocked_at(grid, v.x + dx, v.y) ||
            blocked_at(grid, v.x, v.y + dy) || blocked_at(grid, v.x + dx, v.y + dy))
          continue;
        Move move{i, grid.frame.index({v.x + dx, v.y + dy}), std::hypot(dx, dy), 1e300, 0.0};
        for (int k = 0; k <= 16; ++k) {
          const double c = own_clearance(grid, {v.x + 0.5 + dx * k / 16.0, v.y + 0.5 + dy * k / 16.0});
          move.clearance = std::min(move.clearance, c);
          if (k % 4 == 0) move.exposure += move.length * (k % 16 == 0 ? 1.0 : k == 8 ? 2.0 : 4.0) / c / 12.0;
        }
        moves.push_back(move);
      }
    }
  }
  return moves;
}

/// Returns the least costs of what the moves that keep that clearance can reach, by rounds over all of them.
std::vector<double> own_costs(const Blocked& grid, const std::vector<Move>& moves, Cell start, double kept,
                              double weight) {
  std::vector<double> cost(grid.cells.size(), 1e300);
  cost[grid.frame.index(start)] = 0.0;
  for (bool better = true; better;) {
    better = false;
    for (const Move& move : moves) {
      if (move.clearance < kept) continue;
      const double through = cost[move.from] + move.length + weight * move.exposure;
      if (through >= cost[move.to] - 1e-12) continue;
      cost[move.to] = through;
      better = true;
    }
  }
  return cost;
}

/// The largest clearance at which the goal is still reached: all that occur are tried.
double own_widest(const Blocked& grid, const std::vector<Move>& moves, Cell start, Cell goal) {
  double widest = -1.0;
  for (const Move& bottleneck : moves) {
    if (bottleneck.clearance <= widest) continue;
    const auto cost = own_costs(grid, moves, start, bottleneck.clearance - 1e-9, 0.0);
    if (cost[grid.frame.index(goal)] < 1e299) widest = bottleneck.clearance;
  }
  return widest;
}

TEST(Safest, IsTheBestOfAllPathsOnSmallGrids) {
  Rng rng = Rng(31).child("safest");
  int joined = 0;
  std::size_t legs = 0, moves_legs = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    Blocked grid = random_grid(rng, 9);
    const auto cell = [&] {
      return Cell{static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.width))),
                  static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.height)))};
    };
    const Cell start = cell(), goal = cell();
    grid[start] = grid[goal] = 0;
    if (start == goal) continue;
    SafestOptions options;
    options.weight_m = std::pow(10.0, rng.uniform(-2.0, 3.0));
    options.kept = rng.below(3) == 0 ? rng.uniform(0.0, 1.0) : 1.0;
    options.along_moves = true;
    const Problem problem = problem_on(grid, start, goal);
    Workspace workspace;
    const auto plan = safest(problem, options, {}, workspace);
    const auto moves = moves_of(grid);
    const double widest = own_widest(grid, moves, start, goal);
    ASSERT_EQ(plan.has_value(), widest > 0.0) << "grid " << i;
    if (!plan) continue;
    ++joined;
    const double kept = options.kept * widest;
    const double cost = own_costs(grid, moves, start, kept - 1e-9, options.weight_m)[grid.frame.index(goal)];
    ASSERT_NEAR(plan->cost, cost, 1e-9 * cost) << "grid " << i;
    ASSERT_NEAR(plan->lower_bound, cost, 1e-9 * cost) << "grid " << i;
    ASSERT_GE(safety_of(*plan, problem).clearance_m, kept - 1e-9) << "grid " << i;
    ASSERT_TRUE(check(*plan, problem)) << check(*plan, problem).error().sentence;

    options.along_moves = false;
    const auto straight = safest(problem, options, {}, workspace);
    ASSERT_LE(straight->cost, plan->cost * (1.0 + 1e-12)) << "grid " << i;
    legs += straight->waypoints.size();
    moves_legs += plan->waypoints.size();
    ASSERT_GE(safety_of(*straight, problem).clearance_m, kept - 1e-9) << "grid " << i;
    ASSERT_TRUE(check(*straight, problem)) << check(*straight, problem).error().sentence;
  }
  EXPECT_GT(joined, 40);
  EXPECT_LT(legs, moves_legs);
}

/// On open ground, where most moves are farther from everything than small grids have room for.
TEST(Safest, ExposureFarFromEverythingPassesTheJudge) {
  Rng rng = Rng(34).child("open");
  Workspace workspace;
  for (int i = 0; i < testing::cases(3); ++i) {
    Blocked grid(GridFrame{{0.0, 0.0}, 0.1, 90, 70});
    for (int k = 0; k < 6; ++k)
      grid[{20 + static_cast<int>(rng.below(50)), static_cast<int>(rng.below(70))}] = 1;
    const Problem problem = problem_on(grid, {2, 3}, {87, 66});
    const auto plan = safest(problem, {}, {}, workspace);
    ASSERT_TRUE(plan.has_value());
    ASSERT_TRUE(check(*plan, problem)) << check(*plan, problem).error().sentence;
    const Safety safety = safety_of(*plan, problem);
    EXPECT_NEAR(plan->exposure / safety.exposure, 1.0, 0.005);
  }
}

TEST(Safest, CostsTheSameOnMirroredAndTurnedGrids) {
  Rng rng = Rng(32).child("mirror");
  for (int i = 0; i < testing::cases(60); ++i) {
    Blocked grid = random_grid(rng, 16);
    const Cell start{0, 0}, goal{grid.frame.width - 1, grid.frame.height - 1};
    grid[start] = grid[goal] = 0;
    GridFrame turned = grid.frame;
    std::swap(turned.width, turned.height);
    Blocked other(turned);
    for (std::size_t k = 0; k < grid.cells.size(); ++k) {
      const Cell c = grid.frame.cell(k);
      other[{c.y, goal.x - c.x}] = grid.cells[k];
    }
    SafestOptions options;
    options.along_moves = true;
    Workspace workspace;
    const auto one = safest(problem_on(grid, start, goal), options, {}, workspace);
    const auto two = safest(problem_on(other, {0, goal.x}, {goal.y, 0}), options, {}, workspace);
    const auto back = safest(problem_on(grid, goal, start), options, {}, workspace);
    ASSERT_EQ(one.has_value(), two.has_value());
    if (!one) continue;
    ASSERT_NEAR(one->cost, two->cost, 1e-9 * one->cost);
    ASSERT_NEAR(one->cost, back->cost, 1e-9 * one->cost);
  }
}

/// The errors that the header states, over every kind of move.
TEST(Safest, SimpsonsRuleIsAsGoodAsStated) {
  Rng rng = Rng(33).child("simpson");
  double worst = 0.0;
  for (int i = 0; i < testing::cases(12); ++i) {
    Blocked grid = random_grid(rng, 16);
    if (i % 2 == 0) {
      for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < 0.02 ? 1 : 0;
    }
    for (const Move& move : moves_of(grid)) {
      const Cell a = grid.frame.cell(move.from), b = grid.frame.cell(move.to);
      double truth = 0.0;
      constexpr int parts = 100;
      for (int k = 0; k < parts; ++k) {
        const double t = (k + 0.5) / parts;
        truth += move.length / parts /
                 own_clearance(grid, {a.x + 0.5 + t * (b.x - a.x), a.y + 0.5 + t * (b.y - a.y)});
      }
      worst = std::max(worst, std::abs(move.exposure / truth - 1.0));
    }
  }
  EXPECT_LT(worst, 0.01);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Safest, TradesClearanceForLengthByItsOptions) {
  // A short gap of one cell between two walls, and a long one of five cells above.
  const Blocked grid =
      drawn({"...........", "...........", "...........", "...........", "...........", ".....#.....",
             ".....#.....", ".....#.....", "...........", ".....#.....", ".....#....."});
  const Problem problem = problem_on(grid, {2, 2}, {8, 2});
  Workspace workspace;
  SafestOptions options;
  const auto wide = safest(problem, options, {}, workspace);
  options.kept = 0.0;
  options.weight_m = 0.0;
  const auto shortest = safest(problem, options, {}, workspace);
  options.along_moves = true;
  const auto moves = safest(problem, options, {}, workspace);
  ASSERT_TRUE(wide && shortest && moves);
  EXPECT_NEAR(safety_of(*wide, problem).clearance_m, 2.5, 1e-9);  // of the start, and of the upper gap
  EXPECT_NEAR(safety_of(*shortest, problem).clearance_m, 0.5, 0.01);
  EXPECT_NEAR(moves->cost, plan_path(problem, "dijkstra")->cost, 1e-9);
}

TEST(Safest, RefusesInASentence) {
  const Problem problem = problem_on(drawn({"...", "..."}), {0, 0}, {2, 1});
  Workspace workspace;
  for (const double bad : {-1.0, 1e7, std::nan("")}) {
    SafestOptions options;
    options.weight_m = bad;
    EXPECT_EQ(safest(problem, options, {}, workspace).error().where, "weight");
  }
  SafestOptions options;
  options.kept = 1.1;
  EXPECT_EQ(safest(problem, options, {}, workspace).error().where, "kept");
  const Blocked long_grid(GridFrame{{0.0, 0.0}, 1.0, 16'384, 1});
  const auto refused = safest(problem_on(long_grid, {0, 0}, {9, 0}), {}, {}, workspace);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().sentence.find("16384 x 1"), std::string::npos) << refused.error().sentence;
}

TEST(Safety, IsWhatGeometrySays) {
  // Along the middle of a corridor of 4 x 20 m whose walls are at 2 m, and straight towards its end.
  const Blocked corridor(GridFrame{{10.0, 0.0}, 0.5, 40, 8});
  auto ground = std::make_shared<const GridMap>(*GridMap::of(corridor, GridModel::cells));
  Plan plan;
  plan.waypoints = {{15.0, 2.0}, {20.0, 2.0}};
  const Safety along = safety_of(plan, {ground, {}, {}});
  EXPECT_NEAR(along.clearance_m, 2.0, 1e-12);
  EXPECT_NEAR(along.exposure, 2.5, 1e-9);
  plan.waypoints = {{11.0, 2.0}, {10.25, 2.0}};
  const Safety ahead = safety_of(plan, {ground, {}, {}});
  EXPECT_NEAR(ahead.clearance_m, 0.25, 1e-12);
  EXPECT_NEAR(ahead.exposure, std::log(4.0), 2e-4);
  EXPECT_LT(ahead.exposure_low, std::log(4.0));
  EXPECT_GT(ahead.exposure_high, std::log(4.0));
  plan.waypoints = {{11.0, 2.0}, {10.0, 2.0}};
  EXPECT_TRUE(std::isinf(safety_of(plan, {ground, {}, {}}).exposure));
}

TEST(Safety, TheJudgeFindsAWrongExposure) {
  const Problem problem = problem_on(drawn({".......", "...#...", "......."}), {0, 0}, {6, 2});
  Workspace workspace;
  auto plan = safest(problem, {}, {}, workspace);
  ASSERT_TRUE(plan && check(*plan, problem));
  const double added = 0.1 * plan->exposure;
  plan->exposure += added;
  plan->cost += plan->weights.per_exposure_m * added;
  const auto verdict = check(*plan, problem);
  ASSERT_FALSE(verdict.has_value());
  EXPECT_NE(verdict.error().sentence.find("exposure"), std::string::npos);
}

}  // namespace
}  // namespace outrider
