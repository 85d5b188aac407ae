#include "drive_followers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/drive/run.hpp"

namespace outrider::bench {
namespace {

constexpr double half_side_m = 2.0;  ///< of the square
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Tags on the four walls, all of which face inwards, so that some are in view from almost everywhere.
TagMap tags_on_walls(double height_m) {
  constexpr int on_a_wall = 6;
  TagMap map;
  for (int wall = 0; wall < 4; ++wall) {
    for (int i = 0; i < on_a_wall; ++i) {
      const double along_m = half_side_m * ((2.0 * i + 1.0) / on_a_wall - 1.0);
      const Vec2 at = rotated(0.5 * pi * wall, {half_side_m, along_m});
      map.tags.push_back(upright_tag(wall * on_a_wall + i, {at.x, at.y, height_m}, pi + 0.5 * pi * wall));
    }
  }
  return map;
}

/// Waypoints at random, then posts at random where they leave the legs a little room.
void draw_course(DriveTask& task, Rng& rng) {
  constexpr double edge_m = 0.5, least_leg_m = 0.4, post_m = 0.04, least_gap_m = 0.05;
  const double side_m = half_side_m - edge_m;
  const auto point = [&] { return Vec2{rng.uniform(-side_m, side_m), rng.uniform(-side_m, side_m)}; };
  task.start = {point(), rng.uniform(-pi, pi)};
  task.waypoints.clear();
  const std::size_t count = 3 + rng.below(4);
  std::vector<Vec2> points = {task.start.position};
  while (task.waypoints.size() < count) {
    const Vec2 at = point();
    if (distance(at, points.back()) < least_leg_m) continue;
    points.push_back(at);
    const bool last = task.waypoints.size() + 1 == count;
    task.waypoints.push_back({{at, rng.uniform(-pi, pi)}, last || rng.uniform() > 1.0 / 3.0});
  }
  constexpr int tries = 40;
  for (int i = 0; i < tries; ++i) {
    const Vec2 at = point();
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < points.size(); ++k)
      nearest_m = std::min(nearest_m, distance(at, Segment{points[k - 1], points[k]}));
    if (nearest_m < task.radius_m + post_m + least_gap_m) continue;
    task.world.solids.push_back(
        {fmt::format("post_{}", i), {{at.x, at.y, 0.06}, {}}, CylinderShape{post_m, 0.06}});
    if (task.world.solids.size() == 8) break;
  }
}

DriveTask course(const DriveSetup& setup, std::uint64_t number) {
  DriveTask task = setup.task;
  task.calibration = {};
  task.world = {};
  task.world.name = "square with posts";
  task.world.bounds = {{-half_side_m, -half_side_m}, {half_side_m, half_side_m}};
  task.eye.height_m = 0.1;
  task.tags = tags_on_walls(0.2);
  task.follow.mode = "holonomic";
  switch (number % 3) {
    case 0: task.chassis = mecanum_chassis(0.03, 0.1225); break;
    case 1: task.chassis = holonomic_chassis(0.03, 0.15); break;
    default: task.chassis = differential_chassis(0.03, 0.1225); task.follow.mode = "rotate_then_go";
  }
  Rng rng = Rng(number).child("course");
  draw_course(task, rng);
  return task;
}

/// Returns the distance, m, by which the clearance of the legs exceeds the robot's radius.
double leg_margin_m(const DriveTask& task) {
  std::vector<Vec2> points = {task.start.position};
  for (const Waypoint& waypoint : task.waypoints) points.push_back(waypoint.pose.position);
  return way_clearance_m(points, CollisionMap::of(task.world, task.eye.height_m)) - task.radius_m;
}

void count(FollowerRow& row, const DriveTask& task, const Report& report) {
  ++row.runs;
  row.done += report.status == "done" ? 1 : 0;
  row.doubtful += report.status == "doubtful" ? 1 : 0;
  row.lost += report.reason.find("lost:") != std::string::npos ? 1 : 0;
  const double margin_m = metric(report, "clearance_m") - task.radius_m;
  row.touched += margin_m < 0.0 ? 1 : 0;
  row.margins.push_back(margin_m / std::min(1.0, leg_margin_m(task)));
  row.deviations_m.push_back(metric(report, "deviation_m"));
  row.times.push_back(report.status == "done" ? metric(report, "time_s") / metric(report, "ideal_s")
                                              : unknown);
  const Table& waypoints = table_named(report, "waypoints");
  for (const auto& values : waypoints.rows) {
    const TableRow waypoint{waypoints, values};
    row.missed += waypoint.text("outcome") == "missed" ? 1 : 0;
    if (waypoint.number("stop") == 0.0) continue;
    ++row.stops;
    if (!std::isfinite(waypoint.number("reached_s"))) continue;
    ++row.reached;
    const double off_m = std::hypot(waypoint.number("dx"), waypoint.number("dy"));
    row.stop_errors_m.push_back(off_m);
    const bool is_false = off_m > metric(report, "tolerance_m") ||
                          std::abs(waypoint.number("dtheta")) > metric(report, "tolerance_rad");
    row.false_reached += is_false ? 1 : 0;
  }
}

/// Removes the times of courses that a follower did not finish from all rows.
void keep_common_times(std::vector<FollowerRow>& rows) {
  for (std::size_t i = rows.front().times.size(); i-- > 0;) {
    const bool all =
        std::ranges::all_of(rows, [&](const FollowerRow& row) { return std::isfinite(row.times[i]); });
    if (all) continue;
    for (FollowerRow& row : rows) row.times.erase(row.times.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

std::vector<FollowerRow> compare_followers(const DriveSetup& setup, const std::vector<std::string>& followers,
                                           std::int64_t courses, const BenchObserver& observer) {
  std::vector<FollowerRow> rows;
  for (const std::string& follower : followers) {
    next_step(observer, follower + ", courses");
    FollowerRow row;
    row.follower = follower;
    for (std::int64_t i = 1; i <= courses; ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      DriveTask task = course(setup, number);
      task.follow.follower = follower;
      Log log;
      count(row, task, run_drive(task, setup.sim, false, number, log));
      if (observer.part) observer.part(static_cast<double>(i) / static_cast<double>(courses));
    }
    rows.push_back(std::move(row));
  }
  keep_common_times(rows);
  return rows;
}

nlohmann::ordered_json row_json(const FollowerRow& row) {
  return {{"follower", row.follower},
          {"runs", row.runs},
          {"done", row.done},
          {"doubtful", row.doubtful},
          {"lost", row.lost},
          {"touched", row.touched},
          {"missed", row.missed},
          {"stops", row.stops},
          {"reached", row.reached},
          {"false_reached", row.false_reached},
          {"timed", row.times.size()},
          {"time_ratio_median", quantile(row.times, 0.5)},
          {"time_ratio_90", quantile(row.times, 0.9)},
          {"stop_error_m_median", quantile(row.stop_errors_m, 0.5)},
          {"stop_error_m_90", quantile(row.stop_errors_m, 0.9)},
          {"stop_error_m_most", quantile(row.stop_errors_m, 1.0)},
          {"deviation_m_median", quantile(row.deviations_m, 0.5)},
          {"deviation_m_90", quantile(row.deviations_m, 0.9)},
          {"margin_ratio_median", quantile(row.margins, 0.5)},
          {"margin_ratio_10", quantile(row.margins, 0.1)},
          {"margin_ratio_least", quantile(row.margins, 0.0)}};
}

std::string table_text(const std::vector<FollowerRow>& rows) {
  std::string text =
      fmt::format("\n  {:<13} {:>5} {:>5} {:>9} {:>5} {:>8} {:>7} {:>12} {:>6} {:>14} {:>20} {:>15} {:>18}\n",
                  "follower", "runs", "done", "doubtful", "lost", "touched", "missed", "reached", "false",
                  "time / ideal", "stop error, mm", "off legs, mm", "margin / legs");
  text += fmt::format("  {:>78} {:>14} {:>20} {:>15} {:>18}\n", "", "50 %   90 %", "50 %   90 %   most",
                      "50 %   90 %", "50 %  10 %  least");
  for (const FollowerRow& row : rows) {
    text += fmt::format(
        "  {:<13} {:>5} {:>5} {:>9} {:>5} {:>8} {:>7} {:>7}/{:<4} {:>6} {:>7.2f} {:>6.2f} {:>7.1f} {:>6.1f} "
        "{:>5.1f} "
        "{:>8.0f} {:>6.0f} {:>6.2f} {:>5.2f} {:>5.2f}\n",
        row.follower, row.runs, row.done, row.doubtful, row.lost, row.touched, row.missed, row.reached,
        row.stops, row.false_reached, quantile(row.times, 0.5), quantile(row.times, 0.9),
        1e3 * quantile(row.stop_errors_m, 0.5), 1e3 * quantile(row.stop_errors_m, 0.9),
        1e3 * quantile(row.stop_errors_m, 1.0), 1e3 * quantile(row.deviations_m, 0.5),
        1e3 * quantile(row.deviations_m, 0.9), quantile(row.margins, 0.5), quantile(row.margins, 0.1),
        quantile(row.margins, 0.0));
  }
  return text;
}

}  // namespace outrider::bench
