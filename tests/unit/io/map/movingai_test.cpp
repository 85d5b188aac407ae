#include "outrider/io/map/movingai.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <queue>

#include "support/data.hpp"

namespace outrider {
namespace {

const std::string small_map = "type octile\nheight 2\nwidth 3\nmap\n.@T\nGSW\n";
const std::string small_scenario = "version 1\n0\tsmall.map\t3\t2\t0\t0\t1\t1\t2.41421356\n";

/// Slow twin of the benchmark's rule: 8-connected, no cutting of corners.
double octile_length(const Grid<std::uint8_t>& blocked, Cell start, Cell goal) {
  std::vector<double> best(blocked.cells.size(), 1e18);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto free = [&](Cell c) { return blocked.contains(c) && blocked[c] == 0; };
  best[blocked.frame.index(start)] = 0.0;
  open.emplace(0.0, blocked.frame.index(start));
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    const Cell c = blocked.frame.cell(index);
    if (c == goal) return cost;
    if (cost > best[index]) continue;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const Cell next{c.x + dx, c.y + dy};
        if (!free(next) || !free({c.x + dx, c.y}) || !free({c.x, c.y + dy})) continue;
        const double to = cost + (dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0);
        const std::size_t at = blocked.frame.index(next);
        if (to >= best[at]) continue;
        best[at] = to;
        open.emplace(to, at);
      }
    }
  }
  return -1.0;
}

TEST(MovingAi, FirstRowIsTheTop) {
  const auto map = movingai_map_from_text(small_map, "small.map");
  ASSERT_TRUE(map) << to_string(map.error());
  EXPECT_EQ(map->frame, (GridFrame{{0, 0}, 1.0, 3, 2}));
  EXPECT_EQ(map->cells, (std::vector<std::uint8_t>{0, 0, 1, 0, 1, 1}));
}

TEST(MovingAi, ScenarioIsFlippedWithItsMap) {
  const auto queries = movingai_scenario_from_text(small_scenario, "small.scen");
  ASSERT_TRUE(queries) << to_string(queries.error());
  ASSERT_EQ(queries->size(), 1U);
  EXPECT_EQ(queries->front().start, (Cell{0, 1}));
  EXPECT_EQ(queries->front().goal, (Cell{1, 0}));
  EXPECT_EQ(queries->front().map, "small.map");
  EXPECT_DOUBLE_EQ(queries->front().octile_length, 2.41421356);
}

TEST(MovingAi, FaultsNameTheLine) {
  const auto fault = [](std::string text) {
    const auto map = movingai_map_from_text(text, "m");
    return map ? "none" : to_string(map.error());
  };
  EXPECT_EQ(fault("type octile\nheight 0\nwidth 3\nmap\n"),
            "m:2: 'height 0' is not valid; this line is 'height N' with N from 1 to 100000");
  EXPECT_EQ(fault("type octile\nheight 2\nwidth 3\nmap\n...\n..\n....\n"),
            "m:6: this row has 2 letters; the header says 3");
  EXPECT_TRUE(fault("type octile\nheight 1\nwidth 3\nmap\n.x.\n").starts_with("m:5: 'x' is no letter"));
  EXPECT_TRUE(fault("type tile\n").starts_with("m:1: "));
  EXPECT_TRUE(fault("").starts_with("m:1: "));
  EXPECT_NE(fault("type octile\nheight 100000\nwidth 1000\nmap\n").find("cut short"), std::string::npos);
  EXPECT_NE(fault("type octile\nheight 100000\nwidth 100000\nmap\n").find("the most"), std::string::npos);
  for (const char* row : {"0 m 3 2 0 0 1 1", "0 m 3 2 0 0 3 1 1", "0 m 3 2 -1 0 1 1 1", "0 m 3 2 0 0 1 1 nan",
                          "x m 3 2 0 0 1 1 1", "0 m 0 2 0 0 1 1 1"}) {
    const auto queries = movingai_scenario_from_text(std::string("version 1\n") + row, "s");
    ASSERT_FALSE(queries) << row;
    EXPECT_EQ(queries.error().where, "s:2");
  }
}

TEST(MovingAi, PublishedLengthsHoldOnTheFlippedGrid) {
  const auto folder = test::data_folder() / "grids" / "dao";
  OUTRIDER_NEEDS_DATA(folder);
  const auto map = load_movingai_map((folder / "arena.map").string());
  const auto queries = load_movingai_scenario((folder / "arena.map.scen").string());
  ASSERT_TRUE(map && queries);
  ASSERT_GT(queries->size(), 100U);
  for (const MovingAiQuery& query : *queries) {
    ASSERT_EQ(query.width, map->frame.width);
    ASSERT_EQ(query.height, map->frame.height);
    EXPECT_NEAR(octile_length(*map, query.start, query.goal), query.octile_length,
                7e-6 * query.octile_length + 1e-9);  // the files round
  }
}

TEST(MovingAi, ReadsEveryPublishedFile) {
  const auto folder = test::data_folder() / "grids";
  OUTRIDER_NEEDS_DATA(folder);
  int maps = 0;
  int scenarios = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::string name = entry.path().filename().string();
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    if (name.ends_with(".map")) {
      const auto map = load_movingai_map(entry.path().string());
      EXPECT_TRUE(map) << to_string(map.error());
      ++maps;
    } else if (name.ends_with(".scen")) {
      const auto queries = load_movingai_scenario(entry.path().string());
      EXPECT_TRUE(queries) << to_string(queries.error());
      ++scenarios;
    }
  }
  EXPECT_GT(maps, 10);
  EXPECT_GT(scenarios, 10);
}

TEST(MovingAi, SurvivesDamage) {
  Rng rng(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto map = movingai_map_from_text(test::damaged(small_map, rng), "m");
    if (map) {
      EXPECT_EQ(map->cells.size(), map->frame.size());
    }
    const auto queries = movingai_scenario_from_text(test::damaged(small_scenario, rng), "s");
    if (!queries) continue;
    for (const MovingAiQuery& query : *queries)
      EXPECT_TRUE(query.start.x < query.width && query.start.y >= 0);
  }
}

}  // namespace
}  // namespace outrider
