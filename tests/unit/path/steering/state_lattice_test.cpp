#include "outrider/path/steering/state_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "outline_way.hpp"
#include "outrider/core/units.hpp"
#include "outrider/motion/turning_path.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/pieces.hpp"
#include "outrider/path/steering/hybrid_a_star.hpp"
#include "steering/motions/lattice_motions.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Dijkstra over the same motions on cells of 1 m, without estimates, lists of cells or hashing: every motion
/// against every blocked cell, by the exact distances of the judge.
class Twin {
 public:
  Twin(const GridMap& ground, const LatticeMotions& motions, const StateLatticeOptions& options,
       const std::vector<Vec2>& outline)
      : ground_(ground), motions_(motions), options_(options), outline_(outline) {}

  double least(Cell from, std::optional<std::uint32_t> heading, Cell to, std::optional<std::uint32_t> end) {
    using Place = std::tuple<int, int, std::uint32_t, int>;
    std::map<Place, double> settled;
    std::priority_queue<std::pair<double, Place>, std::vector<std::pair<double, Place>>, std::greater<>>
        queue;
    for (std::uint32_t h = 0; h < motions_.headings(); ++h) {
      const Vec2 p{from.x + 0.5, from.y + 0.5};
      if (!touches({p, p, {}, 0.0}, motions_.heading_rad(h)) && (!heading || h == *heading))
        queue.push({0.0, {from.x, from.y, h, 0}});
    }
    while (!queue.empty()) {
      const auto [cost, place] = queue.top();
      queue.pop();
      if (!settled.try_emplace(place, cost).second) continue;
      const auto [x, y, h, way] = place;
      if (x == to.x && y == to.y && (!end || h == *end)) return cost;
      for (const LatticeMotion& motion : motions_.from(h)) {
        if (!clear(motion, {x, y})) continue;
        const int now = motion.backward ? -1 : 1;
        const double price = motion.cost + (way == -now ? options_.steering.cusp_price_m : 0.0);
        queue.push({cost + price, {x + motion.shift.x, y + motion.shift.y, motion.heading, now}});
      }
    }
    return infinite;
  }

 private:
  bool clear(const LatticeMotion& motion, Cell at) const {
    for (PathPiece piece : motion.pieces) {
      const Vec2 by{double(at.x), double(at.y)};
      for (Vec2* p : {&piece.from, &piece.to, &piece.centre}) *p = *p + by;
      if (touches(piece, heading_in(piece))) return false;
    }
    return true;
  }
  bool touches(const PathPiece& piece, double heading_rad) const {
    const OutlineWay way(piece, heading_rad, outline_, GridFrame{{}, 1.0, 1, 1});
    const Box2 box = way.bounds().grown(1.0);
    for (int y = static_cast<int>(std::floor(box.low.y)); y <= box.high.y; ++y) {
      for (int x = static_cast<int>(std::floor(box.low.x)); x <= box.high.x; ++x) {
        if (ground_.blocked({x, y}) && way.gap({x, y}) < 1e-9) return true;
      }
    }
    return false;
  }

  const GridMap& ground_;
  const LatticeMotions& motions_;
  const StateLatticeOptions& options_;
  const std::vector<Vec2>& outline_;
};

TEST(StateLattice, CostsWhatDijkstraOverTheSameMotionsFinds) {
  Rng rng = Rng(6).child("twin");
  Workspace workspace;
  int joined = 0, missed = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 9, 9});
    const double density = rng.uniform(0.0, 0.3);
    for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < density ? 1 : 0;
    const auto ground = std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::cells));
    StateLatticeOptions options;
    options.headings = rng.below(2) == 0 ? 8 : 16;
    options.steering.turning_radius_m = rng.uniform(0.5, 2.0);
    options.steering.reverse = rng.below(2) == 0;
    options.steering.cusp_price_m = rng.below(3) == 0 ? 0.0 : rng.uniform(0.1, 3.0);
    options.steering.backward_price = rng.uniform(1.0, 2.0);
    const auto place = [&] { return Cell{static_cast<int>(rng.below(9)), static_cast<int>(rng.below(9))}; };
    const Cell from = place(), to = place();
    if (grid[from] != 0 || grid[to] != 0 || from == to) continue;
    Problem problem{ground, ground->point(from), ground->point(to)};
    if (rng.below(2) == 0) problem.outline = testing::random_outline(rng, rng.uniform(0.2, 1.2));
    if (rng.below(2) == 0) problem.start_heading_rad = rng.uniform(-pi, pi);
    if (rng.below(2) == 0) problem.goal_heading_rad = rng.uniform(-pi, pi);
    const auto plan = state_lattice(problem, options, {}, workspace);
    LatticeMotions motions;
    motions.make({static_cast<std::uint32_t>(options.headings), 2, options.steering.turning_radius_m,
                  options.steering.reverse, options.steering.backward_price,
                  problem.outline.empty() ? std::vector<Vec2>{{}} : problem.outline, ground->stride});
    const auto nearest = [&](std::optional<double> heading) -> std::optional<std::uint32_t> {
      if (!heading) return std::nullopt;
      return motions.nearest_heading(*heading);
    };
    const double least =
        Twin(*ground, motions, options, problem.outline)
            .least(from, nearest(problem.start_heading_rad), to, nearest(problem.goal_heading_rad));
    ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "case " << i;
    if (!plan) {
      ++missed;
      continue;
    }
    ++joined;
    EXPECT_NEAR(plan->cost, least, 1e-6) << "case " << i;
    EXPECT_DOUBLE_EQ(plan->lower_bound, plan->cost);
    const auto verdict = check(*plan, problem);
    EXPECT_TRUE(verdict.has_value()) << "case " << i << ": " << to_string(verdict.error());
  }
  EXPECT_GT(joined, testing::cases(15));
  EXPECT_GT(missed, 0);
}

TEST(StateLattice, ALargerWeightKeepsItsRatio) {
  Rng rng = Rng(8).child("weight");
  Workspace workspace;
  for (int i = 0; i < testing::cases(20); ++i) {
    auto grid = Grid<std::uint8_t>(GridFrame{{}, 0.1, 60, 60});
    for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < 0.02 ? 1 : 0;
    const auto ground = std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::cells));
    const Problem problem{ground, {0.55, 0.55}, {5.45, 5.45}, nullptr, 0.0, 0.5 * pi};
    StateLatticeOptions options;
    const auto best = state_lattice(problem, options, {}, workspace);
    options.weight = 2.0;
    const auto quick = state_lattice(problem, options, {}, workspace);
    ASSERT_EQ(best.has_value(), quick.has_value());
    if (!best) continue;
    EXPECT_LE(quick->cost, 2.0 * best->cost + 1e-9);
    EXPECT_LE(quick->lower_bound, best->cost + 1e-9);
    EXPECT_TRUE(check(*quick, problem).has_value());
    // A bound for all robots of that kind, from a planner that shares no motions with it.
    Problem snapped = problem;
    const auto hybrid = hybrid_a_star(snapped, {}, {}, workspace);
    if (hybrid) {
      EXPECT_GE(best->cost, hybrid->lower_bound - 1e-9);
    }
  }
}

TEST(StateLattice, EndsAreThoseOfTheLattice) {
  const auto ground = std::make_shared<const GridMap>(
      *GridMap::of(Grid<std::uint8_t>(GridFrame{{-2.0, -2.0}, 0.1, 40, 40}), GridModel::cells));
  Workspace workspace;
  const Problem problem{ground, {-1.52, -1.51}, {1.02, 1.44}, nullptr, 0.2, -0.3};
  const auto plan = state_lattice(problem, {}, {}, workspace);
  ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
  EXPECT_TRUE(check(*plan, problem).has_value());
  EXPECT_GT(plan->reached_within, 0.0);
  EXPECT_LT(plan->reached_within, 0.071);
  ASSERT_TRUE(plan->steering->snap_rad.has_value());
  EXPECT_NEAR(*plan->steering->snap_rad, 0.5 * std::atan2(1.0, 2.0), 1e-12);
  Plan exact = *plan;
  exact.steering->snap_rad.reset();
  EXPECT_FALSE(check(exact, problem).has_value()) << "it does not begin exactly there";
}

TEST(StateLattice, RefusesWhatMakesNoLattice) {
  const auto ground = std::make_shared<const GridMap>(
      *GridMap::of(Grid<std::uint8_t>(GridFrame{{}, 0.1, 40, 40}), GridModel::cells));
  Workspace workspace;
  const auto where = [&](const StateLatticeOptions& options) {
    const auto plan = state_lattice({ground, {1.0, 1.0}, {3.0, 3.0}}, options, {}, workspace);
    EXPECT_FALSE(plan.has_value());
    return plan ? std::string() : plan.error().where;
  };
  StateLatticeOptions options;
  options.headings = 12;
  EXPECT_EQ(where(options), "headings");
  options = {};
  options.steering.turning_radius_m = 50.0;
  EXPECT_EQ(where(options), "turning_radius");
  options = {};
  options.turns = 0;
  EXPECT_EQ(where(options), "turns");
}

}  // namespace
}  // namespace outrider
