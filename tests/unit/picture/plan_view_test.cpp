#include "outrider/picture/plan_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/mapping_messages.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool has(const std::string& svg, const std::string& part) { return svg.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

/// Returns true if the legend has the words.
bool legend(const std::string& svg, const std::string& words) {
  return has(svg, "y=\"12\">" + words + "</text>");
}

/// A run in a square of 10 m.
Log run_log() {
  Log log;
  outrider_msgs::RunInfo info;
  info.job = "guard";
  info.world = "yard";
  info.high = {10.0, 10.0};
  info.robot_radius = 0.3;
  log.append(topic::run, 0.0, info);
  return log;
}

nav_msgs::OccupancyGrid grid(std::uint32_t width, std::uint32_t height, std::vector<std::int8_t> data) {
  nav_msgs::OccupancyGrid grid;
  grid.info.resolution = 1.0F;
  grid.info.width = width;
  grid.info.height = height;
  grid.data = std::move(data);
  return grid;
}

TEST(PlanView, AnEmptyLogIsAnEmptyPicture) {
  const std::string svg = plan_view(Log());
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\""));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_TRUE(has(svg, "<title>Plan view</title>"));
  EXPECT_EQ(count(svg, "y=\"12\">"), 0U) << "an entry of the legend";
}

TEST(PlanView, TellsTheRunItsEndAndTheScale) {
  Log log = run_log();
  log_event(log, 81.0, "end", "it is over");
  const std::string svg = plan_view(log, {.width_px = 1040.0});
  EXPECT_TRUE(has(svg, "<title>guard: yard</title>"));
  EXPECT_TRUE(has(svg, "1 min 21 s"));
  EXPECT_TRUE(has(svg, ">1 m</text>"));
  EXPECT_TRUE(has(svg, "h80.0v-5")) << "10 m are 800 px high, so the bar of 1 m is 80 px long";
}

TEST(PlanView, TheLegendNamesExactlyWhatIsDrawn) {
  Log log = run_log();
  log_pose(log, 0.0, {{1.0, 1.0}, 0.0});
  log_pose(log, 1.0, {{2.0, 1.0}, 0.0});
  log_pose(log, 2.0, {{3.0, 2.0}, 0.5});
  const std::string svg = plan_view(log);
  for (const char* words :
       {"driven, at first", "driven, at last", "robot at the start", "robot at the end"}) {
    EXPECT_TRUE(legend(svg, words)) << words;
  }
  EXPECT_EQ(count(svg, "y=\"12\">"), 4U);
}

TEST(PlanView, DrawsARobotWithAnOutlineAsThat) {
  Log log = run_log();
  log_footprint(log, {{-0.5, -0.5}, {2.0, -0.5}, {2.0, 0.5}, {-0.5, 0.5}});
  log_pose(log, 0.0, {{5.0, 5.0}, 0.5 * pi});
  log_pose(log, 1.0, {{5.0, 6.0}, 0.5 * pi});
  const std::string svg = plan_view(log, {.width_px = 1040.0});
  EXPECT_TRUE(has(svg, "d=\"M440 440 440 240 360 240 360 440 440 440Z\"")) << "at the start, 80 px a metre";
  EXPECT_TRUE(has(svg, "d=\"M440 360 440 160 360 160 360 360 440 360Z\"")) << "at the end";
}

TEST(PlanView, DrawsMapsWithTheirUpdatesAsRuns) {
  Log log;
  log.append(topic::map, 0.0, grid(4, 2, {0, 0, 0, 0, -1, -1, -1, -1}));
  log.append(topic::map_updates, 1.0, map_msgs::OccupancyGridUpdate{{}, 1, 1, 2, 1, {100, 100}});
  const std::string svg = plan_view(log);
  EXPECT_TRUE(has(svg, "d=\"M0 0h4v1h-4z\"")) << "free";
  EXPECT_TRUE(has(svg, "d=\"M1 1h2v1h-2z\"")) << "occupied";
  EXPECT_TRUE(legend(svg, "mapped: occupied"));
  EXPECT_TRUE(legend(svg, "not mapped"));
}

TEST(PlanView, DrawsCostsSearchesAndFiringRegions) {
  Log log;
  log.append(topic::cost_grid, 0.0, outrider_msgs::CostGrid{{}, 1.0, 3, 1, {1.0, 20.0, -1.0}});
  log.append(topic::paid, 2.0, outrider_msgs::PaidCost{42.0});
  log.append(topic::costmap, 0.0, grid(3, 1, {0, 99, 100}));
  log.append(topic::expanded, 0.0, grid(3, 1, {0, 100, -1}));
  log.append(topic::firing_regions, 0.0, outrider_msgs::FiringRegion{"a", grid(3, 1, {0, 40, -1})});
  log.append(topic::firing_regions, 0.0, outrider_msgs::FiringRegion{"b", grid(3, 1, {0, 9, -1})});
  const std::string svg = plan_view(log);
  for (const char* words : {"cost 1 to 20; 42 paid in all", "wall", "no room for the robot's centre",
                            "occupied", "expanded; the later, the darker", "0 to 2 of 2 targets in range"}) {
    EXPECT_TRUE(legend(svg, words)) << words;
  }
}

TEST(PlanView, DrawsTheGround) {
  Log log = run_log();
  const outrider_msgs::Outline square{points_of({{1.0, 1.0}, {4.0, 1.0}, {4.0, 4.0}})};
  const outrider_msgs::RoundedPolygon disk{points_of({{7.0, 7.0}}), 0.5};
  log.append(topic::solids, 0.0,
             outrider_msgs::Solids{
                 {{"hut", "box", {disk}, 0.0, 2.0, true}, {"roof", "box", {disk}, 2.0, 3.0, false}}});
  outrider_msgs::Terrain terrain;
  terrain.contours = {{0.5, points_of({{1.0, 1.0}, {2.0, 3.0}})}, {1.5, points_of({{3.0, 1.0}, {2.0, 5.0}})}};
  terrain.steep = {disk};
  log.append(topic::terrain, 0.0, terrain);
  log.append(topic::coverage_area, 0.0,
             outrider_msgs::CoverageArea{{square}, {square}, {square}, {square}, {}});
  const std::string svg = plan_view(log);
  for (const char* words :
       {"solid; the taller, the darker", "overhead, not in the way", "too steep to drive on",
        "contours from 0.5 to 1.5 m", "out of reach", "missed", "covered more than once"}) {
    EXPECT_TRUE(legend(svg, words)) << words;
  }
}

TEST(PlanView, DrawsWallsWhereThereAreNoSolids) {
  Log log = run_log();
  const outrider_msgs::Outline square{points_of({{1.0, 1.0}, {4.0, 1.0}, {4.0, 4.0}})};
  log.append(topic::walls, 0.0, outrider_msgs::Outlines{{square}});
  const std::string svg = plan_view(log);
  EXPECT_TRUE(legend(svg, "wall"));
  EXPECT_TRUE(legend(svg, "no room for the robot's centre"));
}

TEST(PlanView, ShowsATrackThatLeavesTheWorld) {
  Log log = run_log();
  log_pose(log, 0.0, {{1.0, 1.0}, 0.0});
  log_pose(log, 1.0, {{21.0, 1.0}, 0.0});
  EXPECT_TRUE(has(plan_view(log, {.width_px = 250.0}), "10 90 210 90\"")) << "21 m at 10 px/m";
}

TEST(PlanView, DrawsPathsTracksAndBeliefs) {
  Log log = run_log();
  const std::vector<Vec2> points = {{1.0, 1.0}, {4.0, 5.0}};
  log_plan(log, 0.0, points);
  log.append("/plan/theta_star", 0.0, path_of(0.0, points));
  log.append(topic::reference, 0.0, path_of(0.0, points));
  log.append(topic::trajectory, 0.0, path_of({0.0, 1.0}, {{points[0], 0.0}, {points[1], 0.0}}));
  log.append("/robot_2/pose", 0.0, stamped(0.0, {points[0], 0.0}));
  log.append("/robot_2/pose", 1.0, stamped(1.0, {points[1], 0.0}));
  log.append(topic::target_pose, 0.0, stamped(0.0, {points[0], 0.0}));
  log.append(topic::target_pose, 1.0, stamped(1.0, {points[1], 0.0}));
  for (const double time_s : {0.0, 1.0}) {
    log_belief(log, time_s, {(1.0 + time_s) * points[0], 0.0}, Eigen::Matrix3d::Identity(), false);
    nav_msgs::Odometry odometry;
    odometry.pose.pose = pose_of(Pose2{(1.0 + time_s) * points[0], 0.0});
    log.append(topic::odometry, time_s, odometry);
  }
  log.append(topic::loops, 1.0, outrider_msgs::Loops{{{0.5, {1.0, 1.0}, {4.0, 5.0}}}});
  const std::string svg = plan_view(log);
  for (const char* words :
       {"planned path", "theta_star: 5.00 m", "reference", "settled track", "robot_2", "target",
        "believed track", "its uncertainty, 2\u03c3", "odometry alone", "loop closed (1)"}) {
    EXPECT_TRUE(legend(svg, words)) << words;
  }
}

TEST(PlanView, RobotsThatDriveAtOnceHaveColoursOfTheirOwn) {
  Log log = run_log();
  for (int i = 0; i < 32; ++i) {
    const double y = 0.1 * i;
    log.append("/plan/cbs", 0.0, path_of({0.0, 1.0}, {{{1.0, y}, 0.0}, {{4.0, y}, 0.0}}));
  }
  const std::string svg = plan_view(log);
  for (const char* words : {"cbs: robots 1, 11, 21, ...", "cbs: robots 2, 12, 22, ...",
                            "cbs: robots 3, 13, 23", "cbs: robots 10, 20, 30"}) {
    EXPECT_TRUE(legend(svg, words)) << words;
  }
  EXPECT_FALSE(has(svg, "32 paths"));
  Log single = run_log();
  single.append("/plan/cbs", 0.0, path_of({0.0, 1.0}, {{{1.0, 0.0}, 0.0}, {{4.0, 0.0}, 0.0}}));
  EXPECT_TRUE(legend(plan_view(single), "cbs: 3.00 m"));
}

TEST(PlanView, TheOdometryBeginsWhereTheRobotWas) {
  const auto drawn = [](const Pose2& odom_T_start) {
    Log log = run_log();
    for (const double time_s : {0.0, 1.0}) {
      log_pose(log, time_s, {{2.0 + time_s, 2.0}, 0.0});
      nav_msgs::Odometry odometry;
      odometry.pose.pose = pose_of(compose(odom_T_start, Pose2{{1.5 * time_s, 0.0}, 0.0}));
      log.append(topic::odometry, time_s, odometry);
    }
    return plan_view(log);
  };
  EXPECT_TRUE(legend(drawn({}), "odometry alone"));
  EXPECT_EQ(drawn({}), drawn({{5.0, -3.0}, 0.0})) << "its own frame begins anywhere";
  EXPECT_EQ(drawn({}), drawn({{0.0, 0.0}, 1.5707963267948966}));
}

TEST(PlanView, TheLaterATrackTheDarker) {
  Log log = run_log();
  for (int i = 0; i < 60; ++i) log_pose(log, i, {{0.1 * i, 5.0}, 0.0});
  const std::string svg = plan_view(log);
  const auto opacity_from = [&](const std::string& start) {
    const std::size_t at = svg.find("path d=\"M" + start), found = svg.find("opacity=\"", at);
    return at == std::string::npos ? 0.0 : std::stod(svg.substr(found + 9));
  };
  EXPECT_GT(opacity_from("46 "), 0.0) << "0.6 m at 76.8 px/m";
  EXPECT_GT(opacity_from("230.5 "), opacity_from("46 ")) << "3 m";
}

TEST(PlanView, DrawsMarks) {
  Log log = run_log();
  log.append(topic::landmarks, 0.0,
             outrider_msgs::Landmarks{{{7, 0.0, {2.0, 2.0}, 0.1, 0.2, 0.3, 5, {2.1, 2.0}}}});
  log.append(topic::tags, 0.0, outrider_msgs::Tags{{{3, {1.0, 9.0, unknown}, 0.0, 0.16}}});
  outrider_msgs::Waypoints waypoints;
  waypoints.waypoints = {{{1.0, 5.0}, 0.0, true, 3.0, {}, 0.0}, {{3.0, 5.0}, 0.0, true, unknown, {}, 0.0}};
  log.append(topic::waypoints, 0.0, waypoints);
  log.append(topic::goal, 0.0, stamped(0.0, {{5.0, 5.0}, 0.0}));
  log.append(topic::refusals, 0.0, outrider_msgs::Refusal{{6.0, 5.0}, "too narrow"});
  log.append(topic::supplies, 0.0, outrider_msgs::Supplies{5.0, 5.0, {{"well", {8.0, 2.0}, true, true}}});
  outrider_msgs::Shot shot;
  shot.contact_point = {4.0, 4.0, 0.5};
  log.append(topic::shots, 1.0, shot);
  shot.hit = true;
  log.append(topic::shots, 2.0, shot);
  for (const char* status : {"reached", "failed", "unreachable", "waiting"}) {
    outrider_msgs::Target target;
    target.name = status;
    target.status = status;
    target.size = {0.4, 0.2, 0.3};
    log.append(topic::targets, 0.0, target);
    log.append(topic::target_positions, 0.0, outrider_msgs::TargetPosition{status, {3.0, 8.0, 0.0}, {}});
  }
  const std::string svg = plan_view(log);
  for (const char* words :
       {"landmark, 2\u03c3 (1)", "true place of a landmark", "tag, and where it faces", "waypoint, reached",
        "waypoint, not reached", "goal (1)", "frontier left unexplored (1)", "water", "charge",
        "shot that hit (1)", "shot that missed (1)", "target reached (1)", "target failed (1)",
        "target unreachable (1)", "target waiting (1)"}) {
    EXPECT_TRUE(legend(svg, words)) << words;
  }
  EXPECT_TRUE(has(svg, ">well</text>"));
  EXPECT_TRUE(has(svg, ">tag 3</text>"));
}

TEST(PlanView, LeavesUnknownNumbersOut) {
  Log log;
  outrider_msgs::RunInfo info;
  info.low = info.high = {unknown, unknown};
  info.robot_radius = unknown;
  log.append(topic::run, 0.0, info);
  for (const double x : {0.0, 1.0, unknown, 3.0, std::numeric_limits<double>::infinity(), 5.0}) {
    log_pose(log, x, {{x, 1.0}, 0.0});
    log_belief(log, x, {{x, 1.0}, unknown}, unknown * Eigen::Matrix3d::Identity(), false);
  }
  log.append(topic::landmarks, 0.0,
             outrider_msgs::Landmarks{{{1, 0.0, {1.0, unknown}, unknown, 1.0, 0.0, 1, {unknown, 1.0}}}});
  log.append(topic::solids, 0.0,
             outrider_msgs::Solids{{{"x", "box", {{points_of({{unknown, 1.0}}), 1.0}}, 0.0, unknown, true}}});
  log.append(topic::cost_grid, 0.0, outrider_msgs::CostGrid{{}, unknown, 1, 1, {unknown}});
  outrider_msgs::Shot shot;
  shot.muzzle = {unknown, 0.0, 0.0};
  log.append(topic::shots, 0.0, shot);
  const std::string svg = plan_view(log);
  EXPECT_FALSE(has(svg, "nan"));
  EXPECT_FALSE(has(svg, "inf"));
  EXPECT_TRUE(legend(svg, "driven, at last"));
}

TEST(PlanView, NamesCannotBreakOut) {
  Log log = run_log();
  outrider_msgs::RunInfo info;
  info.job = "<script>";
  info.world = "a&b\"\xff\n";
  log.append(topic::run, 1.0, info);
  log.append("/plan/<b>", 0.0, path_of(0.0, {{0.0, 0.0}, {1.0, 1.0}}));
  const std::string svg = plan_view(log);
  EXPECT_FALSE(has(svg, "<script>"));
  EXPECT_FALSE(has(svg, "<b>"));
  EXPECT_TRUE(has(svg, "&lt;script&gt;: a&amp;b\"??"));
}

TEST(PlanView, ALongLogStaysSmall) {
  Log log = run_log();
  for (int i = 0; i < 72'000; ++i) {  // two hours at 10 Hz
    const double t = 0.1 * i;
    const Pose2 pose{
        {5.0 + 4.0 * std::sin(0.31 * t), 5.0 + 4.0 * std::cos(0.47 * t + 0.001 * t * std::sin(t))}, t};
    log.append(topic::pose, t, stamped(t, pose));
    log_belief(log, t, pose, 1e-3 * Eigen::Matrix3d::Identity(), false);
  }
  std::vector<std::int8_t> cells;
  for (std::size_t i = 0; i < 1000 * 1000; ++i) cells.push_back(i % 7 < 3 ? 100 : 0);
  log.append(topic::map, 0.0, grid(1000, 1000, std::move(cells)));
  const std::string svg = plan_view(log);
  EXPECT_LE(svg.size(), 400'000U);
  EXPECT_GE(svg.size(), 20'000U);
  EXPECT_TRUE(legend(svg, "driven, at last"));
}

TEST(PlanView, TheSameLogGivesTheSameBytes) {
  const auto drawn = [] {
    Log log = run_log();
    for (int i = 0; i < 100; ++i) log_pose(log, i, {{0.1 * i, 5.0 + std::sin(i)}, 0.1 * i});
    return plan_view(log);
  };
  EXPECT_EQ(drawn(), drawn());
}

}  // namespace
}  // namespace outrider
