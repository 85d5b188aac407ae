#include "clearance/exposure_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

#include "clearance/exposure_descent.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/clearance/medial_axis.hpp"
#include "outrider/path/clearance/safest.hpp"
#include "outrider/path/clearance/widest.hpp"
#include "polygon_worlds.hpp"
#include "support/costly_cases.hpp"

namespace outrider {
namespace {

/// The least cost along the legs of a fine lattice in 16 directions, by Dijkstra: at most a few per cent
/// above the least of all paths, and never below it.
class LatticeOracle {
 public:
  LatticeOracle(const LegCost& cost, int cells) : cost_(cost) {
    const Box2& box = cost.ground.bounds;
    step_m_ = std::max(box.size().x, box.size().y) / cells;
    width_ = static_cast<int>(box.size().x / step_m_) + 2;
    height_ = static_cast<int>(box.size().y / step_m_) + 2;
    for (int i = 0; i < width_ * height_; ++i)
      free_.push_back(!cost.ground.solid(at(i)) && cost.ground.edge_distance(at(i)) >= cost.least_m);
  }

  double least(Vec2 start, Vec2 goal) {
    std::vector<double> least(free_.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](int node, double value) {
      if (value >= least[static_cast<std::size_t>(node)]) return;
      least[static_cast<std::size_t>(node)] = value;
      queue.emplace(value, node);
    };
    around(start, [&](int node) { offer(node, cost_(start, at(node))); });
    double best = cost_(start, goal);
    while (!queue.empty() && queue.top().first < best) {
      const auto [value, node] = queue.top();
      queue.pop();
      if (value > least[static_cast<std::size_t>(node)]) continue;
      if (distance(at(node), goal) < 3.0 * step_m_) best = std::min(best, value + cost_(at(node), goal));
      around(at(node), [&](int next) {
        const int dx = next % width_ - node % width_, dy = next / width_ - node / width_;
        if (std::gcd(dx, dy) != 1) return;
        if (value + distance(at(node), at(next)) < least[static_cast<std::size_t>(next)])
          offer(next, value + cost_(at(node), at(next)));
      });
    }
    return best;
  }

 private:
  [[nodiscard]] Vec2 at(int node) const {
    return cost_.ground.bounds.low +
           step_m_ * Vec2{static_cast<double>(node % width_), static_cast<double>(node / width_)};
  }
  template <class Visit>
  void around(Vec2 p, Visit visit) const {
    const Vec2 q = (1.0 / step_m_) * (p - cost_.ground.bounds.low);
    const int x = static_cast<int>(std::lround(q.x)), y = static_cast<int>(std::lround(q.y));
    for (int v = std::max(0, y - 2); v <= std::min(height_ - 1, y + 2); ++v) {
      for (int u = std::max(0, x - 2); u <= std::min(width_ - 1, x + 2); ++u) {
        if (free_[static_cast<std::size_t>(v * width_ + u)]) visit(v * width_ + u);
      }
    }
  }

  const LegCost& cost_;
  double step_m_ = 1.0;
  int width_ = 0, height_ = 0;
  std::vector<bool> free_;
};

TEST(ExposureBound, LiesBelowWhatAFineLatticeFindsAndThePlanNearIt) {
  Rng rng = Rng(77).child("bound");
  Workspace workspace;
  int compared = 0;
  double gap = 0.0, off = 0.0;
  for (int i = 0; i < testing::costly_cases(24); ++i) {
    const testing::PolygonWorld world =
        i % 2 == 0 ? testing::scattered_world(rng, 8) : testing::random_world(rng);
    auto made = PolygonGround::of(world.boundary, world.obstacles, world.radius_m);
    ASSERT_TRUE(made);
    const auto ground = std::make_shared<const PolygonGround>(std::move(*made));
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground};
    const double weight_m = i % 3 == 0 ? 10.0 : 1.0, kept = i % 4 < 2 ? 1.0 : 0.3;
    const auto plan = medial_axis(problem, {weight_m, kept}, {}, workspace);
    if (!plan || problem.start == problem.goal) continue;
    SCOPED_TRACE(i);
    const double largest = clearance_m(*widest(problem, {}, {}, workspace), *ground);
    const double least = std::max(world.radius_m, 0.999 * kept * largest) * (1.0 - 1e-9);
    const LegCost cost{*ground, weight_m, least};
    const double found = LatticeOracle(cost, 120).least(problem.start, problem.goal);
    const ExposureQuestion question{*ground, problem.start, problem.goal, weight_m, least};
    double before = 0.0;
    for (const int cells : {32, 128}) {
      const double bound = least_cost_bound(question, cells);
      ASSERT_LE(bound, found * (1.0 + 1e-4));
      ASSERT_LE(bound, plan->cost * (1.0 + 1e-4));
      EXPECT_GE(bound, 0.98 * before) << "more cells tell more";
      before = bound;
    }
    EXPECT_GE(plan->lower_bound, before * (1.0 - 1e-9));
    EXPECT_LE(plan->cost, 1.06 * found);
    const auto safe = safest(problem, {weight_m, kept}, {}, workspace);
    ASSERT_TRUE(safe && check(*safe, problem));
    EXPECT_LE(safe->cost, 1.06 * found);
    EXPECT_LE(safe->lower_bound, found * (1.0 + 1e-4));
    EXPECT_GE(clearance_m(*safe, *ground), 0.998 * kept * largest);
    ++compared;
    gap += plan->cost / plan->lower_bound;
    off += plan->cost / found;
  }
  ASSERT_GT(compared, testing::costly_cases(24) / 3);
  EXPECT_LT(off / compared, 1.01) << "as good as the lattice";
  EXPECT_LT(gap / compared, 1.2);
}

TEST(ExposureBound, IsExactToTheCellsWhereTheCostIsKnown) {
  // A corridor 2 m wide: along its middle, 1 of clearance. No path costs less than 1 + weight a metre.
  auto corridor = PolygonGround::of({{0, 0}, {0, 2}, {20, 2}, {20, 0}}, {}, 0.1);
  ASSERT_TRUE(corridor);
  const double bound = least_cost_bound({*corridor, {2, 1}, {17, 1}, 10.0, 0.1}, 200);
  EXPECT_LE(bound, 15.0 * 11.0 * (1.0 + 1e-9));
  EXPECT_GE(bound, 0.99 * 15.0 * 11.0);
  EXPECT_NEAR(least_cost_bound({*corridor, {2, 1}, {17, 1}, 0.0, 0.1}, 200), 15.0, 0.15) << "the length";
}

TEST(ExposureDescent, BendsAWayToTheMiddleAndNeverCostsMore) {
  auto corridor = PolygonGround::of({{0, 0}, {0, 2}, {20, 2}, {20, 0}}, {}, 0.1);
  ASSERT_TRUE(corridor);
  const LegCost cost{*corridor, 10.0, 0.1};
  const auto total = [&](const std::vector<Vec2>& points) {
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += cost(points[i - 1], points[i]);
    return sum;
  };
  const std::vector<Vec2> aside{{2, 1}, {3, 0.3}, {9, 1.8}, {16, 0.3}, {17, 1}};
  const std::vector<Vec2> bent = descended(aside, cost);
  EXPECT_EQ(bent.front(), aside.front());
  EXPECT_EQ(bent.back(), aside.back());
  EXPECT_LT(total(bent), total(aside));
  EXPECT_NEAR(total(bent), 15.0 * 11.0, 0.005 * 165.0);
}

}  // namespace
}  // namespace outrider
