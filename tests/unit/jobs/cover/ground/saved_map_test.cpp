#include "outrider/jobs/cover/ground/saved_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/jobs/cover/job.hpp"
#include "outrider/jobs/cover/scenario.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

/// Two rooms without a door, 6 m x 3 m and 3 m x 3 m, with a slanted wall in the first. It is turned, and far
/// from the origin, as maps in projected coordinates are.
MapServerMap two_rooms() {
  MapServerMap map{Grid<std::uint8_t>({{600000.0, -400000.0}, 0.05, 184, 62}, free_cell), 0.3};
  for (std::size_t i = 0; i < map.occupancy.frame.size(); ++i) {
    const Cell cell = map.occupancy.frame.cell(i);
    const bool wall = cell.x == 0 || cell.x == 183 || cell.x == 122 || cell.y == 0 || cell.y == 61;
    if (wall || (cell.y - 30 >= cell.x / 3 && cell.x < 60)) map.occupancy.cells[i] = occupied_cell;
    if (cell.x > 90 && cell.x < 96 && cell.y > 25 && cell.y < 33) map.occupancy.cells[i] = unknown_cell;
  }
  return map;
}

class SavedMap : public ::testing::Test {
 protected:
  void SetUp() override {
    scenario.area = (folder.path / "map.yaml").string();
    ASSERT_TRUE(save_map_server(scenario.area, map));
    scenario.problem.width_m = 0.4;
  }
  /// Returns a point of the frame of the map in that of the world, as one may give for the start.
  [[nodiscard]] std::string start_at(int x, int y) const {
    const Vec2 p = world_centre(map, {x, y});
    return std::to_string(p.x) + "," + std::to_string(p.y) + ",0";
  }

  test::Folder folder;
  MapServerMap map = two_rooms();
  CoverScenario scenario;
};

bool in_area(const CoverProblem& problem, Vec2 p) {
  return contains(region_of(problem.boundary, problem.holes), p);
}

/// Every cell at its corners and its middle, through the frames of the map, the world and the area.
TEST_F(SavedMap, TheAreaLiesInsideTheFreeSpaceOfTheLargerRoom) {
  const auto task = load_task(scenario);
  ASSERT_TRUE(task) << to_string(task.error());
  EXPECT_EQ(task->problem.holes.size(), 1U);
  EXPECT_TRUE(task->problem.frame.moved());
  EXPECT_NE(task->note.find("9 m2 of its free space are left out, in 1 part"), std::string::npos)
      << task->note;
  EXPECT_LT(task->problem.boundary.size(), 10U);
  int inside = 0;
  const Region area = region_of(task->problem.boundary, task->problem.holes);
  for (std::size_t i = 0; i < map.occupancy.frame.size(); ++i) {
    const Cell cell = map.occupancy.frame.cell(i);
    const Vec2 middle = world_centre(map, cell), along = direction(map.yaw_rad);
    for (const double x : {-0.02499, 0.0, 0.02499}) {
      for (const double y : {-0.02499, 0.0, 0.02499}) {
        const Vec2 p = task->problem.frame.to_local(middle + x * along + y * perpendicular(along));
        if (!contains(area, p)) continue;
        ++inside;
        ASSERT_EQ(map.occupancy.cells[i], free_cell) << cell.x << ", " << cell.y;
        ASSERT_LT(cell.x, 122);
      }
    }
  }
  EXPECT_GT(inside, 40000);
}

TEST_F(SavedMap, TheStartChoosesTheRoom) {
  scenario.start = start_at(150, 30);
  const auto task = load_task(scenario);
  ASSERT_TRUE(task) << to_string(task.error());
  EXPECT_TRUE(in_area(task->problem, task->problem.start->position));
  EXPECT_NEAR(area_of(region_of(task->problem.boundary, {})), 9.0, 0.05);
}

TEST_F(SavedMap, TheJobCoversIt) {
  CoverJob job;
  job.scenario = scenario;
  ASSERT_TRUE(job.load());
  outrider::Run run;
  const auto done = job.run(run, {});
  ASSERT_TRUE(done) << to_string(done.error());
  EXPECT_EQ(run.report.status, "done") << run.report.reason;
}

TEST_F(SavedMap, WhatCannotBeIsRefusedWithItsKey) {
  scenario.problem.transfers = true;
  EXPECT_EQ(load_task(scenario).error().where, "transfers");
  scenario.problem.transfers = false;
  scenario.units = "degrees";
  EXPECT_EQ(load_task(scenario).error().where, "units");
  scenario.units = "auto";
  scenario.problem.width_m = 4.0;
  EXPECT_EQ(load_task(scenario).error().sentence,
            "nowhere on the map is free space 4 m wide; give a robot that fits");
  std::ranges::fill(map.occupancy.cells, unknown_cell);
  ASSERT_TRUE(save_map_server(scenario.area, map));
  EXPECT_EQ(load_task(scenario).error().where, scenario.area);
}

TEST_F(SavedMap, PolygonsInYamlAreNotTakenForAMap) {
  const std::string polygons = folder.write("area.yaml",
                                            "polygon:\n  polygon:\n    hull:\n      points: [{x: 0, y: 0}, "
                                            "{x: 4, y: 0}, {x: 4, y: 4}]\n    holes: []\n");
  EXPECT_FALSE(saved_map(polygons).value());
  scenario.area = polygons;
  EXPECT_EQ(load_task(scenario).value().problem.boundary.size(), 3U);
}

}  // namespace
}  // namespace outrider
