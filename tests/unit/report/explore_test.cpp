#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "outrider/core/rng.hpp"
#include "outrider/report/discovery.hpp"
#include "outrider/report/json.hpp"
#include "sample_explore.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

std::vector<int> expanded(const std::vector<int>& runs) {
  std::vector<int> values;
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    values.insert(values.end(), static_cast<std::size_t>(runs[i + 1]), runs[i]);
  }
  return values;
}

GridFrame frame_at(Cell low, int width, int height) {
  return {{0.05 * low.x, 0.05 * low.y}, 0.05, width, height};
}

TEST(Discovery, KeepsTheFirstTimeOfEachCellWhileTheMapGrows) {
  Rng rng(7);
  for (int round = 0; round < testing::cases(20); ++round) {
    Discovery discovery;
    std::map<std::pair<int, int>, double> first_s;  // by place on the lattice
    Cell low{-3, -2};
    Grid<std::uint8_t> grid(frame_at(low, 6, 5), unknown_cell);
    for (int note = 0; note < 30; ++note) {
      const bool grows = note % 7 == 3;
      if (grows) {
        Grid<std::uint8_t> larger(
            frame_at({low.x - 2, low.y - 1}, grid.frame.width + 3, grid.frame.height + 2), unknown_cell);
        for (std::size_t i = 0; i < grid.cells.size(); ++i) {
          const Cell cell = grid.frame.cell(i);
          larger[{cell.x + 2, cell.y + 1}] = grid.cells[i];
        }
        low = {low.x - 2, low.y - 1};
        grid = larger;
      }
      std::vector<std::size_t> changed;
      for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        if (rng.uniform(0.0, 1.0) > 0.05) continue;
        grid.cells[i] = rng.uniform(0.0, 1.0) < 0.3 ? occupied_cell : free_cell;
        changed.push_back(i);
        const Cell cell = grid.frame.cell(i);
        first_s.try_emplace({cell.x + low.x, cell.y + low.y}, note);
      }
      discovery.note(grid, grows, changed, note);
    }
    const ReportMap map = discovery.map(grid);
    const auto states = expanded(map.state_runs);
    const auto steps = expanded(map.known_runs);
    ASSERT_EQ(states.size(), static_cast<std::size_t>(map.columns * map.rows));
    ASSERT_EQ(steps.size(), states.size());
    std::size_t known = 0;
    for (int row = 0; row < map.rows; ++row) {
      for (int column = 0; column < map.columns; ++column) {
        const auto at = static_cast<std::size_t>(row * map.columns + column);
        const Vec2 centre = map.origin + map.cell_m * Vec2{column + 0.5, row + 0.5};
        const Cell cell = grid.frame.cell_at(centre);
        ASSERT_EQ(states[at], grid[cell]);
        if (states[at] == unknown_cell) continue;
        ++known;
        const double first = first_s.at({cell.x + low.x, cell.y + low.y});
        ASSERT_NEAR(steps[at] * map.step_s, first, map.step_s + 1e-6);
      }
    }
    EXPECT_EQ(known, first_s.size());
  }
}

TEST(Discovery, DrawsLargeMapsCoarser) {
  Grid<std::uint8_t> grid(frame_at({0, 0}, 100, 60), free_cell);
  grid[{31, 7}] = occupied_cell;
  Discovery discovery;
  discovery.note(grid, true, {}, 10.0);
  const ReportMap map = discovery.map(grid, 700);
  EXPECT_EQ(map.columns, 34);  // 3 x 3 cells in one: 34 x 20 = 680
  EXPECT_EQ(map.rows, 20);
  EXPECT_DOUBLE_EQ(map.cell_m, 0.15);
  const auto states = expanded(map.state_runs);
  EXPECT_EQ(std::ranges::count(states, static_cast<int>(occupied_cell)), 1);
  EXPECT_EQ(states[2 * 34 + 10], occupied_cell);
}

TEST(Discovery, OfNothingIsEmpty) {
  EXPECT_EQ(Discovery().map(Grid<std::uint8_t>(frame_at({0, 0}, 4, 4), unknown_cell)).columns, 0);
}

TEST(ExploreReport, ReadsBackByteEqual) {
  const std::string text = to_json(test::sample_explore());
  const auto report = report_from_json(text);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(to_json(*report), text);
  ASSERT_TRUE(report->explore);
  EXPECT_EQ(report->explore->refused.size(), 1U);
}

TEST(ExploreReport, KeepsWhatTheRobotSensesWithAndWhatItStandsOn) {
  PageReport report = test::sample_explore();
  EXPECT_EQ(to_json(report).find("\"laser\""), std::string::npos);  // what is not known is left out
  report.explore->laser = ReportLaser{360, 3.5, 0.18, {{0.05, 0.0}, 0.1}};
  report.drive.emplace().camera = ReportCamera{1920, 1080, 701.1, 697.1, 962.4, 524.4, 0.1, 0.2};
  report.drive->tags = {{7, {1.0, 2.0}, 0.5, 0.16, 0.3}, {8, {2.0, 2.0}, 0.5, 0.16}};
  report.terrain.emplace().relief = ReportRelief{{-1.0, -2.0}, {0.5, 0.25}, 2, 3, {0, 1, 2, 3, 4, 5.5}};
  const std::string text = to_json(report);
  const auto back = report_from_json(text);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(to_json(*back), text);
  EXPECT_EQ(back->explore->laser->mount.heading_rad, 0.1);
  EXPECT_EQ(back->drive->camera->cy, 524.4);
  EXPECT_EQ(back->drive->tags[0].height_m, 0.3);
  EXPECT_FALSE(back->drive->tags[1].height_m);
  EXPECT_EQ(back->terrain->relief->heights_m.back(), 5.5);
}

TEST(ExploreReport, FaultsNameThePlace) {
  std::string text = to_json(test::sample_explore());
  text.replace(text.find("\"state_runs\""), 12, "\"state_ruins\"");
  const auto report = report_from_json(text);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().where, "explore.map.state_runs");
}

}  // namespace
}  // namespace outrider
