#include "outrider/jobs/plan/job.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/topics.hpp"
#include "plan_case.hpp"

namespace outrider {
namespace {

using PlanJobTest = PlanCase;
using Names = std::vector<std::string>;

Names files_of(const Run& run) {
  Names names;
  for (const NamedContent& file : run.files) names.push_back(file.path);
  return names;
}

TEST_F(PlanJobTest, DefaultsDependOnTheKindOfMap) {
  const std::string grid = write("a.map", cells), polygons = write("a.txt", room);
  const std::string yard = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/yard/yard.sdf";
  const auto on_cells = plan({{"map", grid}, {"from", "0.5,3.5"}, {"to", "5.5,3.5"}});
  ASSERT_TRUE(on_cells.has_value()) << to_string(on_cells.error());
  EXPECT_EQ(text_of(*on_cells, 0, "planner"), "theta_star");
  EXPECT_EQ(setting(*on_cells, "radius"), "0 m");
  const auto on_polygons = plan({{"map", polygons}, {"query", "1"}});
  ASSERT_TRUE(on_polygons.has_value()) << to_string(on_polygons.error());
  EXPECT_EQ(setting(*on_polygons, "radius"), "0.18 m");
  EXPECT_EQ(text_of(*on_polygons, 0, "planner"), "visibility_graph_reduced");
  EXPECT_EQ(setting(*on_polygons, "planner"), "visibility_graph_reduced");
  EXPECT_EQ(setting(*on_polygons, "model"), "corners");
  EXPECT_EQ(setting(*on_polygons, "resolution"), "0.05 m");
  const auto in_world = plan({{"map", yard}, {"from", "0,-6"}, {"to", "4,4"}});
  ASSERT_TRUE(in_world.has_value()) << to_string(in_world.error());
  EXPECT_EQ(setting(*in_world, "radius"), "0.26 m");
  const auto given = plan({{"map", polygons},
                           {"query", "1"},
                           {"radius", "0.26"},
                           {"planner", "theta_star"},
                           {"model", "cells"},
                           {"resolution", "0.1"}});
  ASSERT_TRUE(given.has_value()) << to_string(given.error());
  EXPECT_EQ(setting(*given, "radius"), "0.26 m");
  EXPECT_EQ(text_of(*given, 0, "planner"), "theta_star");
  EXPECT_EQ(setting(*given, "resolution"), "0.1 m");
}

TEST_F(PlanJobTest, AReportAFileAndATable) {
  const auto run =
      plan({{"map", write("a.map", cells)}, {"from", "0.5,3.5"}, {"to", "5.5,3.5"}, {"planner", "a_star"}});
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  const Report& report = run->report;
  // (0,3) to (2,0), straight under the wall to (4,0) because corners are not cut, then up to (5,3).
  const double cost = 3 * std::sqrt(2.0) + 5;
  EXPECT_EQ(report.job, "plan");
  EXPECT_EQ(report.status, "done");
  EXPECT_EQ(report.reason, "");
  EXPECT_EQ(report.world_name, "a.map");
  EXPECT_NEAR(metric(report, "cost"), cost, 1e-12);
  EXPECT_NEAR(metric(report, "length_m"), cost, 1e-12);
  EXPECT_EQ(metric(report, "paths"), 1.0);
  EXPECT_EQ(metric(report, "rows"), 1.0);
  ASSERT_EQ(report.tables.size(), 2U);
  EXPECT_EQ(&table_named(report, "rows"), &report.tables[0]);
  ASSERT_GE(waypoints_of(*run, 0).size(), 2U);
  EXPECT_EQ(waypoints_of(*run, 0).front(), (Vec2{0.5, 3.5}));
  EXPECT_EQ(waypoints_of(*run, 0).back(), (Vec2{5.5, 3.5}));
  EXPECT_TRUE(std::isnan(number_of(*run, 0, "query")));
  EXPECT_EQ(number_of(*run, 0, "optimal"), 1.0);
  EXPECT_EQ(text_of(*run, 0, "guarantee"), "grid_optimal");
  EXPECT_EQ(files_of(*run), Names{});
  EXPECT_EQ(run->log.messages<nav_msgs::Path>("/plan/a_star").size(), 1U);
  EXPECT_EQ(report.machine_times.front().first, "planning_s");
  EXPECT_NE(plan_job().summary(report).find("a_star"), std::string::npos);
}

TEST_F(PlanJobTest, ThatThereIsNoPathIsAnAnswer) {
  const std::string map = write("a.map", cells);
  const Changes ask = {{"map", map}, {"from", "0.5,3.5"}, {"to", "5.5,3.5"}, {"block", "3,0"}};
  const auto run = plan(ask);
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_EQ(run->report.status, "not_done");
  EXPECT_NE(run->report.reason.find("nothing joins"), std::string::npos) << run->report.reason;
  EXPECT_EQ(text_of(*run, 0, "status"), "no_path");
  EXPECT_EQ(text_of(*run, 0, "reason"), run->report.reason);
  EXPECT_TRUE(std::isnan(number_of(*run, 0, "cost")));
  EXPECT_EQ(metric(run->report, "paths"), 0.0);
  Changes all = ask;
  all.emplace_back("compare", "true");
  const auto compared = plan(all);
  ASSERT_TRUE(compared.has_value()) << to_string(compared.error());
  for (std::size_t i = 0; i < rows_of(*compared); ++i) EXPECT_NE(text_of(*compared, i, "status"), "done");
}

TEST_F(PlanJobTest, CellsAreBlockedThenFreed) {
  const std::string map = write("a.map", cells);
  Changes ask = {{"map", map}, {"from", "0.5,3.5"}, {"to", "5.5,3.5"}, {"planner", "jps"}, {"free", "3,3"}};
  EXPECT_EQ(number_of(*plan(ask), 0, "cost"), 5.0);
  ask.emplace_back("block", "3,0,1,4 0,0");
  EXPECT_EQ(number_of(*plan(ask), 0, "cost"), 5.0);
  const auto with = [&](const char* key, const char* text) {
    return refusal({{"map", map}, {"from", "0.5,3.5"}, {"to", "5.5,3.5"}, {key, text}});
  };
  EXPECT_NE(with("block", "1,1 6,0").find("block 6,0: "), std::string::npos);
  EXPECT_NE(with("block", "6,0").find("leaves the grid"), std::string::npos);
  EXPECT_NE(with("free", "1.5,2").find("1.5 is not valid"), std::string::npos);
  EXPECT_NE(with("block", "1,2,3").find("x,y,width,height"), std::string::npos);
  EXPECT_NE(with("block", "1,2,0,1").find("at least one cell"), std::string::npos);
  EXPECT_NE(refusal({{"map", write("a.txt", room)}, {"query", "1"}, {"block", "1,1"}}).find("exact shapes"),
            std::string::npos);
}

TEST_F(PlanJobTest, FaultsNameTheKey) {
  const std::string map = write("a.map", cells), polygons = write("a.txt", room);
  const auto from_to = [&](const char* from, const char* to, const Changes& more = {}) {
    Changes changes = {{"map", map}, {"from", from}, {"to", to}};
    changes.insert(changes.end(), more.begin(), more.end());
    return refusal(changes);
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {refusal({}), "map: it is missing"},
      {refusal({{"map", map}}), "from: it is missing"},
      {refusal({{"map", map}, {"from", "1,1"}}), "to: it is missing"},
      {from_to("3.5,3.5", "0,0"), "from 3.5,3.5: the start"},
      {from_to("0,0", "3.5,3.5"), "to 3.5,3.5: the goal"},
      {from_to("-1,0", "3.5,3.5"), "from -1,0: "},
      {from_to("0,0", "99,0", {{"compare", "true"}}), "to 99,0: "},
      {from_to("nan,0", "1,1"), "from: 'nan,0'"},
      {from_to("0,0", "1"), "to: '1'"},
      {from_to("0,0", "1,1", {{"model", "hexagons"}}), "model: 'hexagons'"},
      {from_to("0,0", "1,1", {{"planner", "thetastar"}}), "planner: there is no planner 'thetastar'"},
      {from_to("0,0", "1,1", {{"planner", "jps"}, {"model", "corners"}}), "planner: jps takes"},
      {from_to("0,0", "1,1", {{"planner", "visibility_graph"}}), "planner: visibility_graph takes"},
      {refusal({{"map", map}, {"query", "1"}}), "query: it works with a polygon environment only"},
      {refusal({{"map", polygons}, {"query", "1"}, {"from", "1,1"}}), "query: it stands beside"},
      {refusal({{"map", polygons}, {"query", "3"}}), "query: '3' is no query of this map, which has 2"},
      {refusal({{"map", polygons}, {"query", "1x"}}), "query: '1x'"},
      {refusal({{"map", polygons}, {"from", "2.9,1"}, {"to", "7,1"}}), "0.1 m from the nearest edge"},
      {refusal({{"map", polygons}, {"from", "1,1"}, {"to", "9,1"}}), "to 9,1: "},
      {refusal({{"map", polygons}, {"query", "1"}, {"trace", "true"}}), "trace: it shows searches on grids"},
      {from_to("0,0", "1,1 2,2", {{"trace", "true"}}), "trace: it shows one search"},
      {from_to("0,0", "1,1", {{"trace", "true"}, {"compare", "true"}}), "trace: it shows one search"}};
  for (const auto& [text, says] : cases)
    EXPECT_NE(text.find(says), std::string::npos) << text << "; " << says;
}

TEST_F(PlanJobTest, ATraceHasEachExpansion) {
  const auto run = plan({{"map", write("a.map", cells)},
                         {"from", "0,0"},
                         {"to", "5,3"},
                         {"planner", "a_star"},
                         {"trace", "true"}});
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_EQ(files_of(*run), (Names{"trace.json"}));
  const std::string& text = run->files.back().content;
  const auto count = [&](const std::string& what) {
    std::size_t times = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++times;
    return static_cast<double>(times);
  };
  EXPECT_EQ(count("\"vertex\""), number_of(*run, 0, "expansions"));
  const auto* expanded = run->log.latest<nav_msgs::OccupancyGrid>(topic::expanded);
  ASSERT_NE(expanded, nullptr);
  EXPECT_EQ(
      static_cast<double>(std::ranges::count_if(expanded->data, [](int percent) { return percent >= 0; })),
      number_of(*run, 0, "expansions"));
}

TEST_F(PlanJobTest, TheFastestDriveKeepsTheLimitsThatAreGiven) {
  const std::string map = write("a.map", cells);
  const Changes ask = {{"map", map}, {"from", "0.5,3.5"}, {"to", "0.5,0.5"}, {"planner", "a_star"}};
  const auto with = [&](const Changes& more) {
    Changes changes = ask;
    changes.insert(changes.end(), more.begin(), more.end());
    return plan(changes);
  };
  // 3 m straight: 1 s and 0.4 m to 0.8 m/s, and as much to rest.
  const auto usual = with({});
  ASSERT_TRUE(usual.has_value()) << to_string(usual.error());
  EXPECT_NEAR(metric(usual->report, "drive_s"), 2.0 + 2.2 / 0.8, 1e-12);
  EXPECT_NEAR(number_of(*usual, 0, "drive_s"), 2.0 + 2.2 / 0.8, 1e-12);
  const auto braked = with({{"drive.speed", "2"}, {"drive.acceleration", "1"}, {"drive.deceleration", "4"}});
  ASSERT_TRUE(braked.has_value()) << to_string(braked.error());
  // v^2 / 2 + v^2 / 8 = 3 at 2.19 m/s, above the limit: 2 m up, 0.5 m down, 0.5 m at 2 m/s.
  EXPECT_NEAR(metric(braked->report, "drive_s"), 2.0 + 0.25 + 0.5, 1e-12);
  const Table& table = table_named(braked->report, "speed_profile");
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_NEAR((TableRow{table, table.rows[1]}.number("along_m")), 2.0, 1e-12);
  EXPECT_NEAR((TableRow{table, table.rows[2]}.number("speed_mps")), 2.0, 1e-12);
  EXPECT_EQ((TableRow{table, table.rows[2]}.number("acceleration_mps2")), -4.0);
  EXPECT_NEAR((TableRow{table, table.rows[3]}.number("time_s")), 2.75, 1e-12);
  Changes refused = ask;
  refused.emplace_back("drive.lateral_acceleration", "0");
  EXPECT_NE(refusal(refused).find("lateral_acceleration: '0'"), std::string::npos) << refusal(refused);
}

TEST_F(PlanJobTest, TwiceTheSameBytes) {
  const Job job = plan_job();
  const auto task = job.blank();
  ASSERT_TRUE(
      change(*task, {{"map", write("a.txt", room)}, {"query", "all"}, {"compare", "true"}}).has_value());
  const auto once = run_task(job, *task);
  ASSERT_TRUE(once.has_value()) << to_string(once.error());
  const auto again = run_task(job, *task);
  for (std::size_t i = 0; i < once->files.size(); ++i)
    EXPECT_EQ(once->files[i].content, again->files[i].content);
  EXPECT_EQ(once->report.metrics, again->report.metrics);
  EXPECT_EQ(once->report.settings, again->report.settings);
  ASSERT_EQ(rows_of(*once), rows_of(*again));
  for (std::size_t i = 0; i < rows_of(*once); ++i) {
    EXPECT_EQ(waypoints_of(*once, i), waypoints_of(*again, i));
    EXPECT_EQ(value<std::vector<TableArc>>(*once, i, "pieces"),
              value<std::vector<TableArc>>(*again, i, "pieces"));
  }
}

TEST_F(PlanJobTest, AStoppedRunIsCancelled) {
  PlanJob task;
  task.scenario.map = write("a.map", cells);
  task.scenario.from = "0,0";
  task.scenario.to = "5,3";
  ASSERT_TRUE(task.load().has_value());
  std::stop_source source;
  RunWatch watch{.stop = source.get_token()};
  watch.progress = [&](const RunStep& step) {
    if (step.name == "theta_star") source.request_stop();  // while it searches
  };
  outrider::Run run;
  const auto stopped = task.run(run, watch);
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().code, FaultCode::cancelled);
  EXPECT_EQ(task.run(run, watch).error().code, FaultCode::cancelled);
  const auto whole = run_task(plan_job(), task, watch);
  EXPECT_EQ(whole->report.status, "cancelled");
}

}  // namespace
}  // namespace outrider
