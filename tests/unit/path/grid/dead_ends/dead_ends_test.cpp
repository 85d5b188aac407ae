// Dead ends and the bounds of the ways between gates, against shortest lengths to every cell.
#include "grid/dead_ends/dead_ends.hpp"

#include <gtest/gtest.h>

#include <queue>

#include "grid/dead_ends/area_route.hpp"
#include "grid/dead_ends/known_dead_ends.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

GridMap map_of(const Grid<std::uint8_t>& blocked) { return GridMap::of(blocked, GridModel::cells).value(); }

Cell any_cell(Rng& rng, const GridFrame& frame) {
  return {static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width))),
          static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height)))};
}

/// Shortest lengths from a cell to all others, by Dijkstra over the legal moves.
Grid<double> lengths_from(const GridMap& map, Cell from) {
  Grid<double> lengths(map.frame);
  std::fill(lengths.cells.begin(), lengths.cells.end(), unreached);
  std::priority_queue<std::pair<double, std::pair<int, int>>> queue;
  lengths[from] = 0.0;
  queue.push({0.0, {from.x, from.y}});
  while (!queue.empty()) {
    const auto [negative, at] = queue.top();
    queue.pop();
    const Cell c{at.first, at.second};
    if (-negative > lengths[c]) continue;
    for (unsigned move = 0; move < 8; ++move) {
      if (((map.moves[map.index(c)] >> move) & 1U) == 0) continue;
      const Cell to{c.x + grid_moves[move].x, c.y + grid_moves[move].y};
      const double length = lengths[c] + (move < 4 ? 1.0 : std::sqrt(2.0));
      if (length >= lengths[to]) continue;
      lengths[to] = length;
      queue.push({-length, {to.x, to.y}});
    }
  }
  return lengths;
}

Cell from_border(Cell c) { return {c.x + 1, c.y + 1}; }

/// Checks one query, and returns the number of free cells that are in dead ends for it.
int check_query(const GridMap& map, const DeadEnds& ends, AreaRoute& route, Cell start, Cell goal) {
  const auto from_start = lengths_from(map, start), to_goal = lengths_from(map, goal);
  const bool joined = route.begin(ends, map.index(start), map.index(goal), from_border(goal));
  EXPECT_EQ(joined, from_start[goal] != unreached);
  if (!joined) return 0;
  int dropped = 0;
  for (std::size_t i = 0; i < map.frame.size(); ++i) {
    const Cell c = map.frame.cell(i);
    if (map.blocked(c)) continue;
    Octile remaining;
    const bool kept = route.bound(ends, ends.label(map.index(c)), from_border(c), remaining);
    dropped += kept ? 0 : 1;
    const bool on_shortest = from_start[c] + to_goal[c] <= from_start[goal] + 1e-9;
    EXPECT_TRUE(kept || !on_shortest) << "cell " << c.x << ", " << c.y;
    if (kept) {
      EXPECT_LE(remaining.value(), to_goal[c] + 1e-9) << "cell " << c.x << ", " << c.y;
    }
  }
  return dropped;
}

TEST(DeadEnds, HoldNoCellOfAShortestPathAndBoundsAreNeverTooLarge) {
  Rng rng = Rng(71).child("dead ends");
  AreaRoute route;  // one for all maps
  int dropped = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    const auto grid = i % 3 == 0 ? rooms(rng, 40) : random_grid(rng, 30);
    const GridMap map = map_of(grid);
    const DeadEnds ends = dead_ends_of(map);
    for (int k = 0; k < 6; ++k) {
      const Cell start = any_cell(rng, map.frame), goal = any_cell(rng, map.frame);
      if (!map.blocked(start) && !map.blocked(goal)) dropped += check_query(map, ends, route, start, goal);
    }
  }
  EXPECT_GT(dropped, 1000);
}

/// Checks that no step of a shortest path from start to goal shortens the bound by more than its length.
void check_steps(const GridMap& map, const DeadEnds& ends, AreaRoute& route, Cell start, Cell goal) {
  if (!route.begin(ends, map.index(start), map.index(goal), from_border(goal))) return;
  const auto from_start = lengths_from(map, start), to_goal = lengths_from(map, goal);
  for (std::size_t i = 0; i < map.frame.size(); ++i) {
    const Cell c = map.frame.cell(i);
    for (unsigned move = 0; move < 8; ++move) {
      const Cell to{c.x + grid_moves[move].x, c.y + grid_moves[move].y};
      if (((map.moves[map.index(c)] >> move) & 1U) == 0) continue;
      const double step = move < 4 ? 1.0 : std::sqrt(2.0);
      if (from_start[c] + step + to_goal[to] > from_start[goal] + 1e-9) continue;
      Octile here, there;
      EXPECT_TRUE(route.bound(ends, ends.label(map.index(c)), from_border(c), here));
      EXPECT_TRUE(route.bound(ends, ends.label(map.index(to)), from_border(to), there));
      EXPECT_LE(here.value(), step + there.value() + 1e-9) << "cell " << c.x << ", " << c.y;
    }
  }
}

TEST(DeadEnds, BoundsAreConsistentAlongShortestPaths) {
  Rng rng = Rng(72).child("consistent");
  AreaRoute route;
  for (int i = 0; i < testing::cases(150); ++i) {
    const GridMap map = map_of(i % 2 == 0 ? rooms(rng, 30) : random_grid(rng, 24));
    const DeadEnds ends = dead_ends_of(map);
    for (int k = 0; k < 6; ++k) {
      const Cell start = any_cell(rng, map.frame), goal = any_cell(rng, map.frame);
      if (!map.blocked(start) && !map.blocked(goal)) check_steps(map, ends, route, start, goal);
    }
  }
}

TEST(DeadEnds, ARoomBehindADoorIsOneForPathsThatPassIt) {
  const GridMap map = map_of(drawn({"......#...", "......#...", ".####.#.#.", ".#..#...#.", ".#..#.###.",
                                    ".#.##.#.#.", "......#...", "......#..."}));
  const DeadEnds ends = dead_ends_of(map);
  AreaRoute route;
  ASSERT_TRUE(route.begin(ends, map.index({0, 7}), map.index({0, 0}), {1, 1}));
  Octile remaining;
  EXPECT_FALSE(
      route.bound(ends, ends.label(map.index({9, 7})), {10, 8}, remaining));  // beyond the door at (6, 4)
  EXPECT_FALSE(route.bound(ends, ends.label(map.index({3, 4})), {4, 5}, remaining));  // in the closet
  EXPECT_TRUE(route.bound(ends, ends.label(map.index({5, 4})), {6, 5}, remaining));
  ASSERT_TRUE(route.begin(ends, map.index({3, 4}), map.index({9, 0}), {10, 1}));
  ASSERT_TRUE(route.bound(ends, ends.label(map.index({3, 4})), {4, 5}, remaining));
  EXPECT_GT(remaining.value(),
            octile_distance({3, 4}, {9, 0}).value());  // down, out and up to the door first
}

TEST(DeadEnds, HaveTheSameLabelsCellByCell) {
  Rng rng = Rng(73).child("spread");
  for (int i = 0; i < testing::cases(60); ++i) {
    const GridMap map = map_of(i % 2 == 0 ? rooms(rng, 30) : random_grid(rng, 24));
    const DeadEnds ends = dead_ends_of(map);
    DeadEnds spread = ends;
    spread.spread(map.marks.size());
    for (std::uint32_t k = 0; k < map.marks.size(); ++k) {
      if (map.blocked(map.at(k))) continue;
      ASSERT_EQ(spread.label(k), ends.label(k));
    }
  }
}

TEST(DeadEnds, AreFoundAgainOnlyWhenSearchesHaveCostAsMuch) {
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 40, 20});
  const GridMap map = map_of(grid);
  KnownDeadEnds known;
  known.make(map);
  EXPECT_NE(known.of(map), nullptr);
  known.change();
  EXPECT_EQ(known.of(map), nullptr);
  known.spend(99);
  EXPECT_EQ(known.of(map), nullptr);
  known.spend(1);
  EXPECT_NE(known.of(map), nullptr);
}

}  // namespace
}  // namespace outrider
