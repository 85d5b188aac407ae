#include "outrider/jobs/explore/map/traversability_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/growing_map.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::GrowingMap;

constexpr KnownGroundOptions keeps{.margin_m = 0.02, .near_m = 0.06};
constexpr double radius_m = 0.06;

/// Distance from a point to the nearest square of an occupied cell, m.
double nearest_occupied(const Grid<std::uint8_t>& map, Vec2 point) {
  double least = 1e9;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] != occupied_cell) continue;
    const Cell cell = map.frame.cell(i);
    const Vec2 low = map.frame.corner(cell), high = map.frame.corner({cell.x + 1, cell.y + 1});
    const Vec2 nearest{std::clamp(point.x, low.x, high.x), std::clamp(point.y, low.y, high.y)};
    least = std::min(least, distance(nearest, point));
  }
  return least;
}

void expect_as_defined(TraversabilityGrid& ground, const Grid<std::uint8_t>& map) {
  const GridFrame& frame = ground.frame();
  const auto grid = ground.grid();
  Grid<std::uint8_t> taken(frame);
  for (std::uint32_t cell = 0; cell < frame.size(); ++cell) {
    const Cell at = frame.cell(cell);
    const Vec2 centre = frame.centre(at);
    const Cell there = map.frame.cell_at(centre);
    const std::uint8_t value = map.contains(there) ? map[there] : static_cast<std::uint8_t>(unknown_cell);
    ASSERT_EQ(ground.known()[at], value);
    const double away = value == free_cell ? nearest_occupied(map, centre) : 0.0;
    ASSERT_EQ(ground.blocked(cell), value != free_cell || away <= radius_m + keeps.margin_m + 1e-6)
        << at.x << " " << at.y;
    if (value == free_cell) {
      ASSERT_EQ(ground.near_wall(cell), away <= radius_m + keeps.margin_m + keeps.near_m + 1e-6);
    }
    taken[at] = ground.blocked(cell) ? 1 : 0;
  }
  ASSERT_EQ(grid->marks, GridMap::of(taken, GridModel::cells)->marks);
  ASSERT_EQ(grid->moves, GridMap::of(taken, GridModel::cells)->moves);
}

void expect_blocks(const TraversabilityGrid& ground) {
  for (std::uint32_t block = 0; block < ground.blocks().cells.size(); ++block) {
    const Cell low = ground.blocks().frame.cell(block);
    int free = 0, wide = 0;
    for (const Cell step : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}}) {
      const Cell at{2 * low.x + step.x, 2 * low.y + step.y};
      const auto cell = static_cast<std::uint32_t>(ground.frame().index(at));
      ASSERT_EQ(ground.block_of(cell), block);
      if (ground.blocked(cell)) continue;
      ++free;
      wide += ground.near_wall(cell) ? 0 : 1;
    }
    const auto wanted = wide > 0   ? TraversabilityGrid::free_block
                        : free > 0 ? TraversabilityGrid::near_block
                                   : TraversabilityGrid::no_block;
    ASSERT_EQ(ground.blocks().cells[block], wanted);
  }
}

TEST(TraversabilityGrid, IsAfterEveryUpdateAsDefined) {
  for (int n = 0; n < testing::cases(3); ++n) {
    GrowingMap growing(static_cast<std::uint64_t>(n));
    TraversabilityGrid ground(keeps, radius_m);
    for (int i = 0; i < 25; ++i) {
      const MapUpdate update = growing.change();
      ground.update(growing.map, update);
      if (i % 6 != 5) continue;
      ASSERT_NO_FATAL_FAILURE(expect_as_defined(ground, growing.map)) << n << " " << i;
    }
  }
}

TEST(TraversabilityGrid, KeepsAtMostHalfACellOfMargin) {
  TraversabilityGrid ground({.margin_m = 0.5, .near_m = 0.0}, 0.1);
  Grid<std::uint8_t> map(GridFrame{{0, 0}, 0.05, 20, 20}, free_cell);
  map[{10, 10}] = occupied_cell;
  ground.update(map, {.redrawn = true, .cells = {}});
  const auto blocked = [&](Cell cell) {
    return ground.blocked(
        static_cast<std::uint32_t>(ground.frame().index(ground.frame().cell_at(map.frame.centre(cell)))));
  };
  EXPECT_TRUE(blocked({13, 10})) << "0.125 m from the square";
  EXPECT_FALSE(blocked({14, 10})) << "0.175 m from the square";
}

TEST(TraversabilityGrid, MarksOverruleTheMapAndMoveWithItsFrame) {
  TraversabilityGrid ground(keeps, 0.1);
  Grid<std::uint8_t> map(GridFrame{{0, 0}, 0.05, 40, 40}, free_cell);
  for (int y = 0; y < 40; ++y) map[{20, y}] = occupied_cell;
  ground.update(map, {.redrawn = true, .cells = {}});
  const auto at = [&](Vec2 point) {
    return static_cast<std::uint32_t>(ground.frame().index(ground.frame().cell_at(point)));
  };
  ASSERT_TRUE(ground.blocked(at({1.02, 1.0})));
  EXPECT_TRUE(ground.mark_open({{0.5, 1.02}, {1.5, 1.02}}));
  EXPECT_FALSE(ground.mark_open({{0.5, 1.02}, {1.5, 1.02}})) << "nothing is opened twice";
  for (double x = 0.5; x < 1.5; x += 0.01) ASSERT_FALSE(ground.blocked(at({x, 1.02}))) << x;
  EXPECT_TRUE(ground.crowded(at({1.02, 1.02})));
  ground.mark_shut({0.7, 1.02}, 0.06);
  EXPECT_TRUE(ground.blocked(at({0.7, 1.02}))) << "though it was opened";
  EXPECT_FALSE(ground.touched(at({0.7, 1.02})));
  ground.forget_marks();
  EXPECT_TRUE(ground.mark_open({{0.5, 1.02}, {1.5, 1.02}}));
  ground.mark_touched({1.3, 1.02});
  for (double x = 0.5; x < 1.5; x += 0.01) {
    const Vec2 centre = ground.frame().centre(ground.frame().cell_at({x, 1.02}));
    ASSERT_EQ(ground.blocked(at({x, 1.02})), distance(centre, Vec2{1.3, 1.02}) < 0.11) << x;
  }
  ASSERT_NO_FATAL_FAILURE(expect_blocks(ground));
  Grid<std::uint8_t> larger(GridFrame{{-5, -5}, 0.05, 300, 300}, unknown_cell);
  for (int i = 0; i < 1600; ++i) larger[{100 + i % 40, 100 + i / 40}] = map[{i % 40, i / 40}];
  ground.update(larger, {.redrawn = true, .cells = {}});
  EXPECT_FALSE(ground.blocked(at({1.02, 1.02})));
  EXPECT_TRUE(ground.touched(at({1.3, 1.02})));
  ground.forget_marks();
  EXPECT_TRUE(ground.blocked(at({1.02, 1.02})));
  EXPECT_FALSE(ground.blocked(at({1.3, 1.02})));
  ASSERT_NO_FATAL_FAILURE(expect_blocks(ground));
}

TEST(TraversabilityGrid, BlocksSumUpFourCells) {
  GrowingMap growing(7);
  TraversabilityGrid ground(keeps, radius_m);
  for (int i = 0; i < 30; ++i) {
    const MapUpdate update = growing.change();
    ground.update(growing.map, update);
    ASSERT_NO_FATAL_FAILURE(expect_blocks(ground)) << i;
  }
}

TEST(TraversabilityGrid, TellsWhatChangedAndWhereItIsNow) {
  for (int n = 0; n < testing::cases(10); ++n) {
    GrowingMap growing(100 + static_cast<std::uint64_t>(n));
    TraversabilityGrid ground({}, radius_m);
    for (int i = 0; i < 40; ++i) {
      const Grid<std::uint8_t> before = ground.known();
      const MapUpdate update = growing.change();
      const TraversabilityGrid::Change change = ground.update(growing.map, update);
      std::vector<std::uint32_t> differ;
      for (std::uint32_t cell = 0; cell < ground.frame().size(); ++cell) {
        const Cell at = ground.frame().cell(cell);
        const Cell was{at.x - change.shift.x, at.y - change.shift.y};
        const std::uint8_t value =
            before.contains(was) ? before[was] : static_cast<std::uint8_t>(unknown_cell);
        if (value != ground.known().cells[cell]) differ.push_back(cell);
      }
      ASSERT_EQ(change.cells, differ);
      ASSERT_EQ(change.reframed, before.frame != ground.frame());
    }
  }
}

TEST(TraversabilityGrid, BeginsAnewOnAnotherLattice) {
  TraversabilityGrid ground(keeps, radius_m);
  Grid<std::uint8_t> map(GridFrame{{0, 0}, 0.05, 10, 10}, free_cell);
  map[{5, 5}] = occupied_cell;
  ground.update(map, {.redrawn = true, .cells = {}});
  const Grid<std::uint8_t> other(GridFrame{{0.013, 0}, 0.1, 4, 4}, free_cell);
  const auto change = ground.update(other, {.redrawn = true, .cells = {}});
  EXPECT_TRUE(change.new_lattice);
  EXPECT_EQ(change.cells.size(), 16U);
  ASSERT_NO_FATAL_FAILURE(expect_as_defined(ground, other)) << "margins are counted in cells of the new size";
}

}  // namespace
}  // namespace outrider
