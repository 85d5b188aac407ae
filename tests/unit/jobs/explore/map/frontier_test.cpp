#include "outrider/jobs/explore/map/frontier.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/growing_map.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::GrowingMap;

/// From the definition: free cells of the map with an unknown 4-neighbour, as cells of the world's lattice.
std::set<std::pair<int, int>> frontier_cells(const Grid<std::uint8_t>& map) {
  const auto unknown = [&](int x, int y) { return !map.contains({x, y}) || map[{x, y}] == unknown_cell; };
  std::set<std::pair<int, int>> cells;
  for (int y = 0; y < map.frame.height; ++y) {
    for (int x = 0; x < map.frame.width; ++x) {
      if (map[{x, y}] != free_cell) continue;
      if (unknown(x - 1, y) || unknown(x + 1, y) || unknown(x, y - 1) || unknown(x, y + 1))
        cells.emplace(x, y);
    }
  }
  return cells;
}

std::pair<int, int> on_map(const FrontierMap& frontiers, const Grid<std::uint8_t>& map, std::uint32_t cell) {
  const Cell at = map.frame.cell_at(frontiers.frame().centre(frontiers.frame().cell(cell)));
  return {at.x, at.y};
}

using CellSets = std::set<std::set<std::pair<int, int>>>;

CellSets sets_of(const FrontierMap& frontiers, const Grid<std::uint8_t>& map, bool by_group) {
  std::map<std::uint32_t, std::set<std::pair<int, int>>> sets;
  for (const auto& [id, frontier] : frontiers.frontiers()) {
    for (const std::uint32_t cell : frontier.cells) {
      sets[by_group ? frontier.group : id].insert(on_map(frontiers, map, cell));
    }
  }
  CellSets all;
  for (const auto& [id, cells] : sets) all.insert(cells);
  return all;
}

/// Connected by the eight moves, by repeated joining.
CellSets joined(const std::set<std::pair<int, int>>& cells) {
  std::map<std::pair<int, int>, std::pair<int, int>> root;
  for (const auto& cell : cells) root[cell] = cell;
  for (bool again = true; again;) {
    again = false;
    for (auto& [cell, least] : root) {
      for (int k = 0; k < 9; ++k) {
        const auto next = root.find({cell.first + k % 3 - 1, cell.second + k / 3 - 1});
        if (next == root.end() || !(next->second < least)) continue;
        least = next->second;
        again = true;
      }
    }
  }
  std::map<std::pair<int, int>, std::set<std::pair<int, int>>> sets;
  for (const auto& [cell, least] : root) sets[least].insert(cell);
  CellSets all;
  for (const auto& [least, set] : sets) all.insert(set);
  return all;
}

void expect_consistent(const FrontierMap& frontiers, double longest_m) {
  std::size_t owned = 0;
  for (const auto& [id, frontier] : frontiers.frontiers()) {
    ASSERT_EQ(frontier.id, id);
    ASSERT_FALSE(frontier.cells.empty());
    ASSERT_TRUE(std::is_sorted(frontier.cells.begin(), frontier.cells.end()));
    Vec2 sum;
    for (const std::uint32_t cell : frontier.cells) {
      ASSERT_EQ(frontiers.frontier_of(cell), id);
      sum = sum + frontiers.frame().centre(frontiers.frame().cell(cell));
      ASSERT_TRUE(
          frontier.bounds.grown(1e-9).contains(frontiers.frame().centre(frontiers.frame().cell(cell))));
    }
    ASSERT_LT(distance(1.0 / static_cast<double>(frontier.cells.size()) * sum, frontier.centroid), 1e-9);
    ASSERT_LE(std::max(frontier.bounds.size().x, frontier.bounds.size().y), longest_m);
    owned += frontier.cells.size();
  }
  for (std::uint32_t cell = 0; cell < frontiers.frame().size(); ++cell) {
    if (frontiers.frontier_of(cell) != 0) --owned;
  }
  ASSERT_EQ(owned, 0U);
}

TEST(Frontier, IsAfterEveryUpdateWhatAFullComputationGives) {
  FrontierOptions options;
  options.longest_m = 0.4;
  for (int n = 0; n < testing::cases(2); ++n) {
    GrowingMap growing(static_cast<std::uint64_t>(n));
    FrontierMap frontiers(options, 0.1);
    for (int i = 0; i < 60; ++i) {
      const MapUpdate update = growing.change();
      frontiers.update(growing.map, update);
      ASSERT_NO_FATAL_FAILURE(expect_consistent(frontiers, options.longest_m));
      if (i % 2 == 0) continue;
      ASSERT_EQ(sets_of(frontiers, growing.map, true), joined(frontier_cells(growing.map))) << n << " " << i;
      if (i % 4 != 3) continue;
      FrontierMap anew(options, 0.1);
      anew.update(growing.map, {.redrawn = true, .cells = {}});
      ASSERT_EQ(sets_of(frontiers, growing.map, false), sets_of(anew, growing.map, false)) << n << " " << i;
    }
  }
}

TEST(Frontier, KeepsItsIdWhileItsCellsStay) {
  for (int n = 0; n < testing::cases(6); ++n) {
    GrowingMap growing(50 + static_cast<std::uint64_t>(n));
    FrontierMap frontiers({}, 0.1);
    for (int i = 0; i < 60; ++i) {
      std::map<std::uint32_t, std::set<std::pair<int, int>>> before;
      const Vec2 origin = growing.map.frame.origin;
      for (const auto& [id, frontier] : frontiers.frontiers()) {
        for (const std::uint32_t cell : frontier.cells)
          before[id].insert(on_map(frontiers, growing.map, cell));
      }
      const MapUpdate update = growing.change();
      frontiers.update(growing.map, update);
      const Cell shift = growing.map.frame.cell_at(origin + 0.5 * 0.05 * Vec2{1, 1});
      for (const auto& [id, frontier] : frontiers.frontiers()) {
        std::set<std::pair<int, int>> cells;
        for (const std::uint32_t cell : frontier.cells) {
          const auto at = on_map(frontiers, growing.map, cell);
          cells.emplace(at.first - shift.x, at.second - shift.y);
        }
        for (const auto& [old, were] : before) {
          ASSERT_TRUE(were != cells || old == id) << n << " " << i;
        }
      }
    }
  }
}

TEST(Frontier, IsNotCutBelowACell) {
  FrontierOptions options;
  options.longest_m = 1.5;
  FrontierMap frontiers(options, 0.1);
  Grid<std::uint8_t> map(GridFrame{{0, 0}, 3.0, 6, 6}, unknown_cell);
  for (int x = 1; x < 5; ++x) map[{x, 2}] = free_cell;
  ASSERT_GT(map.frame.resolution_m, options.longest_m);
  frontiers.update(map, {.redrawn = true, .cells = {}});
  ASSERT_EQ(frontiers.frontiers().size(), 4U);
  for (const auto& [id, frontier] : frontiers.frontiers()) EXPECT_EQ(frontier.cells.size(), 1U);
}

TEST(Frontier, IsGivenUpAfterPursuitsInVain) {
  FrontierOptions options;
  options.patience = 3;
  FrontierMap frontiers(options, 0.1);
  Grid<std::uint8_t> map(GridFrame{{0, 0}, 0.05, 10, 10}, unknown_cell);
  map[{5, 5}] = free_cell;
  frontiers.update(map, {.redrawn = true, .cells = {}});
  const std::uint32_t id = frontiers.frontiers().begin()->first;
  const auto beside =
      static_cast<std::uint32_t>(frontiers.frame().index(frontiers.frame().cell_at({0.31, 0.26})));
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(frontiers.given_up(beside));
    frontiers.pursue(id);
    frontiers.pursue(id);  // counts once
    frontiers.update(map, {});
  }
  EXPECT_TRUE(frontiers.given_up(beside));
  map[{6, 5}] = free_cell;
  frontiers.update(map, {.redrawn = false, .cells = {map.frame.index({6, 5})}});
  EXPECT_FALSE(frontiers.given_up(beside)) << "what became known is a cell like any other";
}

}  // namespace
}  // namespace outrider
