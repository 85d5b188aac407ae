#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "fleet_task.hpp"
#include "outrider/core/text.hpp"
#include "outrider/job/grid_message.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

nav_msgs::OccupancyGrid cells_of(const GridMap& map) {
  const GridFrame& frame = map.frame;
  auto grid = grid_message(frame, 0.0, 0.0);
  for (std::size_t i = 0; i < frame.size(); ++i) grid.data.push_back(map.blocked(frame.cell(i)) ? 100 : 0);
  return grid;
}

double heading_between(Vec2 from, Vec2 to) { return from == to ? 0.0 : heading_of(to - from); }

nav_msgs::Path timed_path(const std::vector<Cell>& cells, const GridMap& map) {
  std::vector<double> times_s;
  std::vector<Pose2> poses;
  for (std::size_t t = 0; t < cells.size(); ++t) {
    const Vec2 at = map.point(cells[t]), next = map.point(cells[std::min(t + 1, cells.size() - 1)]);
    times_s.push_back(static_cast<double>(t));
    poses.push_back({at, heading_between(at, next)});
  }
  nav_msgs::Path path = path_of(times_s, poses);
  path.header = header_of(0.0, "map");
  return path;
}

}  // namespace

void log_fleet(Log& log, const FleetProblem& problem, const FleetScenario& scenario, const FleetPlan* plan) {
  const Box2 bounds = problem.grid->frame.bounds();
  outrider_msgs::RunInfo info = run_info("fleet", std::nullopt, World{}, scenario.radius_m);
  info.world = printable(std::filesystem::path(scenario.map).filename().string());
  info.low = point_of(bounds.low);
  info.high = point_of(bounds.high);
  log.append(topic::run, 0.0, std::move(info));
  log.append(topic::costmap, 0.0, cells_of(*problem.grid));
  for (std::size_t i = 0; i < problem.starts.size(); ++i) {
    const double ahead_rad = heading_between(problem.starts[i], problem.goals[i]);
    geometry_msgs::PoseWithCovarianceStamped start;
    start.header = header_of(0.0, "map");
    start.pose.pose = pose_of(Pose2{problem.starts[i], ahead_rad});
    log.append(topic::start, 0.0, std::move(start));
    log.append(topic::goal, 0.0, stamped(0.0, {problem.goals[i], ahead_rad}));
    if (plan == nullptr) continue;
    log.append(std::string(topic::plan_of) + scenario.planner, 0.0,
               timed_path(plan->paths[i], *problem.grid));
  }
}

Report fleet_report(const FleetProblem& problem, const FleetPlan& plan) {
  Report report;
  report.status = "done";
  report.metrics = {{"robots", static_cast<double>(plan.paths.size())},
                    {"cost", static_cast<double>(plan.cost)},
                    {"lower_bound", static_cast<double>(plan.lower_bound)},
                    {"optimal", plan.cost == plan.lower_bound ? 1.0 : 0.0},
                    {"makespan", static_cast<double>(plan.paths.front().size() - 1)},
                    {"expansions", static_cast<double>(plan.expansions)}};
  Table rows{"rows", {"robot", "from", "to", "steps", "path"}, {}};
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    std::vector<Vec2> path;
    for (const Cell c : plan.paths[i]) path.push_back(problem.grid->point(c));
    rows.rows.push_back({static_cast<double>(i + 1), path.front(), path.back(),
                         static_cast<double>(arrival_step(plan.paths[i])), std::move(path)});
  }
  report.tables.push_back(std::move(rows));
  return report;
}

std::string fleet_summary(const Report& report) {
  if (report.status != "done") return "";
  std::string text = fmt::format(
      "  {:.0f} robots: sum of costs {:.0f} steps (no plan costs less than {:.0f}), all there "
      "after {:.0f}; {:.0f} expansions\n",
      metric(report, "robots"), metric(report, "cost"), metric(report, "lower_bound"),
      metric(report, "makespan"), metric(report, "expansions"));
  const Table& rows = table_named(report, "rows");
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.rows.size(), 20); ++i) {
    const TableRow row{rows, rows.rows[i]};
    const Vec2 from = row.get<Vec2>("from"), to = row.get<Vec2>("to");
    text += fmt::format("  {:>5.0f}  {:g},{:g} to {:g},{:g} in {:.0f} steps\n", row.number("robot"), from.x,
                        from.y, to.x, to.y, row.number("steps"));
  }
  if (rows.rows.size() > 20) text += fmt::format("  and {} more in run.json\n", rows.rows.size() - 20);
  return text;
}

}  // namespace outrider
