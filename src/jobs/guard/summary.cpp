#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

bool has_metric(const Report& report, std::string_view name) { return !std::isnan(metric(report, name)); }

std::string counted(double count, std::string_view what) {
  return fmt::format("{:.0f} {}{}", count, what, count == 1.0 ? "" : "s");
}

std::string arrivals_summary(const Report& report) {
  return fmt::format(
      "\n  drove {:.1f} m, fired {:.0f} shots, planned {:.0f} times\n"
      "  intruders were inside for {:.1f} s in all, {:.1f} s at most; no policy makes it less than {:.1f} s\n"
      "  the last was hit after {}; no policy makes it less than {}\n",
      metric(report, "driven_m"), metric(report, "shots"), metric(report, "plans"),
      metric(report, "intruder_seconds"), metric(report, "longest_s"),
      metric(report, "intruder_seconds_bound"), duration_text(metric(report, "makespan_s")),
      duration_text(metric(report, "makespan_bound_s")));
}

std::string walkers_summary(const Report& report) {
  return fmt::format(
      "\n  drove {:.1f} m, fired {:.0f} shots, of which {:.1f} were expected to hit\n"
      "  intruders were inside for {:.1f} s in all; the last was hit after {}\n",
      metric(report, "driven_m"), metric(report, "shots"), metric(report, "expected_hits"),
      metric(report, "intruder_seconds"), duration_text(metric(report, "makespan_s")));
}

std::string supply_line(const Report& report) {
  std::string text = fmt::format("  filled up {:.0f} times, {:.0f} of them not as planned",
                                 metric(report, "fills"), metric(report, "unplanned_fills"));
  if (has_metric(report, "least_water"))
    text += fmt::format("; water at least {:g}", metric(report, "least_water"));
  if (has_metric(report, "least_charge_j")) {
    text += fmt::format("; charge at least {:.0f} J", metric(report, "least_charge_j"));
  }
  return text + "\n";
}

std::string passing_line(const Report& report) {
  return fmt::format("  {:.0f} of the shots left while the robot drove, {:.0f} of these hit\n",
                     metric(report, "shots_in_passing"), metric(report, "hits_in_passing"));
}

std::string target_row(const TableRow& row, std::size_t width) {
  if (row.number("shots") == 0.0) {
    return fmt::format("  {:<{}}  {:<11}  {}\n", printable(row.text("name")), width,
                       printable(row.text("status")), printable(row.text("reason")));
  }
  return fmt::format("  {:<{}}  {:<11}  {:>5}  {:>6.1f}  {:>15}  {:>6.1f}  {:>6.1f}  {:>7.2f}\n",
                     printable(row.text("name")), width, printable(row.text("status")), row.number("shots"),
                     row.number("done_s"), fmt::format("({:.2f}, {:.2f})", row.number("x"), row.number("y")),
                     degrees(row.number("pitch_rad")), row.number("speed_mps"), row.number("clearance_m"));
}

/// How far the plan may be from the best: from anywhere, and among the stops offered.
std::string bounds_lines(const Report& report) {
  const double anywhere_s = metric(report, "anywhere_lower_bound_s");
  std::string text;
  if (anywhere_s > 0.0) {
    text = fmt::format("  no mission{} from any place of the grid takes less than {}: a gap of {:.1f} %\n",
                       has_metric(report, "shots_in_passing") ? ", standing or on the move," : "",
                       duration_text(anywhere_s), 100.0 * metric(report, "anywhere_gap"));
  }
  if (metric(report, "stops_offered") > 0.0) {
    text += fmt::format("  no tour of the {:.0f} stops offered takes less than {}: a gap of {:.1f} %{}\n",
                        metric(report, "stops_offered"), duration_text(metric(report, "lower_bound_s")),
                        100.0 * metric(report, "gap"),
                        metric(report, "tour_proven") > 0.0 ? ", the tour is the best" : "");
  }
  return text;
}

std::string planning_line(const Report& report) {
  if (!has_metric(report, "planning_s")) return {};
  std::string text = fmt::format("  planning took {}\n", duration_text(metric(report, "planning_s")));
  const double physics_s = metric(report, "physics_s"), mission_s = metric(report, "mission_s");
  if (!(physics_s > 0.0)) return text;
  return text + fmt::format("  physics: {:.1f} s of the mission in {:.1f} s, {:.1f} times real time\n",
                            mission_s, physics_s, mission_s / physics_s);
}

/// Returns a line for the work of each robot of a team, and one for how long one robot alone would take.
std::string team_lines(const Report& report) {
  std::string text;
  const Table& robots = table_named(report, "robots");
  for (const auto& values : robots.rows) {
    const TableRow row{robots, values};
    text += fmt::format("  robot {:.0f}: {:.0f} targets, drove {:.1f} m, done after {}", row.number("robot"),
                        row.number("targets"), row.number("driven_m"), duration_text(row.number("time_s")));
    if (row.number("waited_s") > 0.0)
      text += fmt::format(", waited {:.1f} s for others", row.number("waited_s"));
    text += "\n";
  }
  return text + fmt::format("  one robot alone: planned {}; never nearer to each other than {:.2f} m\n",
                            duration_text(metric(report, "alone_s")), metric(report, "closest_m"));
}

}  // namespace

std::string guard_summary(const Report& report) {
  std::string text = fmt::format("{}: {:.0f} of {:.0f} targets reached in {}\n\n",
                                 printable(report.world_name), metric(report, "reached"),
                                 metric(report, "targets"), duration_text(metric(report, "mission_s")));
  std::size_t width = 6;
  const Table& targets = table_named(report, "targets");
  for (const auto& values : targets.rows) {
    width = std::max(width, TableRow{targets, values}.text("name").size());
  }
  text += fmt::format("  {:<{}}  {:<11}  {:>5}  {:>6}  {:>15}  {:>6}  {:>6}  {:>7}\n", "target", width,
                      "status", "shots", "at s", "from m", "pitch", "m/s", "clear m");
  for (const auto& values : targets.rows) text += target_row({targets, values}, width);
  if (has_metric(report, "expected_hits")) return text + walkers_summary(report) + planning_line(report);
  if (has_metric(report, "intruder_seconds")) return text + arrivals_summary(report) + planning_line(report);
  text += fmt::format("\n  drove {:.1f} m, turned {:.0f} degrees, fired {}", metric(report, "driven_m"),
                      degrees(metric(report, "turned_rad")), counted(metric(report, "shots"), "shot"));
  if (has_metric(report, "stops")) {  // a mission without a plan has none
    text += fmt::format(" from {}\n  planned {}", counted(metric(report, "stops"), "stop"),
                        duration_text(metric(report, "planned_s")));
  }
  text += "\n";
  if (has_metric(report, "shots_in_passing")) text += passing_line(report);
  text += bounds_lines(report);
  if (has_metric(report, "robots")) text += team_lines(report);
  if (has_metric(report, "fills")) text += supply_line(report);
  return text + planning_line(report);
}

}  // namespace outrider
