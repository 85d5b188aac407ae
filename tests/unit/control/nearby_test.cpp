#include "outrider/control/nearby.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Grid<std::uint8_t> random_map(Rng& rng) {
  Grid<std::uint8_t> map({{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)}, 0.05, 40, 30}, free_cell);
  for (std::uint8_t& cell : map.cells) {
    const double drawn = rng.uniform();
    if (drawn < 0.06) cell = drawn < 0.03 ? occupied_cell : unknown_cell;
  }
  return map;
}

/// Over all cells, by the corners and sides of their squares.
double slow_clearance(const Grid<std::uint8_t>& map, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] != occupied_cell) continue;
    const Vec2 low = map.frame.corner(map.frame.cell(i));
    const Vec2 high = low + map.frame.resolution_m * Vec2{1.0, 1.0};
    const Vec2 nearest{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y)};
    least = std::min(least, distance(p, nearest));
  }
  return least;
}

TEST(Nearby, TellsTheDistanceToWhatStandsThere) {
  Rng rng(5);
  for (int i = 0; i < testing::cases(200); ++i) {
    const Grid<std::uint8_t> map = random_map(rng);
    const Box2 box = map.frame.bounds();
    const Vec2 middle{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
    const double reach_m = rng.uniform(0.3, 1.0);
    const Nearby nearby(map, middle, reach_m);
    const double exact = slow_clearance(map, middle), told = nearby.clearance(middle);
    if (exact < reach_m - map.frame.resolution_m) {
      EXPECT_NEAR(told, exact, 1e-12);
    } else {
      EXPECT_GE(told, exact - 1e-12);
    }
  }
}

TEST(Nearby, TakesPointsInPlaceOfAMap) {
  const Nearby nearby({{1.0, 0.0}, {0.0, 2.0}}, 0.01);
  EXPECT_NEAR(nearby.clearance(Vec2{0.0, 0.0}), 0.99, 1e-12);
  EXPECT_NEAR(nearby.clearance(Vec2{0.0, 1.7}), 0.29, 1e-12);
  EXPECT_NEAR(nearby.clearance(Segment{{0.0, 0.0}, {2.0, 0.0}}), 0.0, 1e-3);
  EXPECT_NEAR(nearby.clearance(Segment{{0.0, 0.5}, {2.0, 0.5}}), 0.49, 2e-3);
}

TEST(Nearby, ASegmentIsAsClearAsItsWorstPoint) {
  Rng rng(6);
  for (int i = 0; i < testing::cases(100); ++i) {
    const Grid<std::uint8_t> map = random_map(rng);
    const Box2 box = map.frame.bounds();
    const Nearby nearby(map, 0.5 * (box.low + box.high), 3.0);
    const auto drawn = [&] {
      return Vec2{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
    };
    const Segment s{drawn(), drawn()};
    double worst = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 400; ++k)
      worst = std::min(worst, slow_clearance(map, s.a + (k / 400.0) * (s.b - s.a)));
    EXPECT_NEAR(nearby.clearance(s), worst, 0.1 * map.frame.resolution_m);
  }
}

TEST(Nearby, NothingIsFarAway) {
  EXPECT_TRUE(std::isinf(Nearby().clearance(Vec2{})));
  EXPECT_TRUE(std::isinf(Nearby(Grid<std::uint8_t>(), {1.0, 2.0}, 1.0).clearance(Segment{{}, {1.0, 0.0}})));
}

}  // namespace
}  // namespace outrider
