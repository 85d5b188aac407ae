#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// Returns what became of a waypoint. Runs of older versions do not say so.
std::string outcome_of(const TableRow& row) {
  if (std::ranges::find(row.table.columns, "outcome") != row.table.columns.end()) return row.text("outcome");
  if (std::isnan(row.number("reached_s"))) return "not reached";
  return "reached";
}

std::string stop_line(std::size_t number, const TableRow& row) {
  std::string text = fmt::format("  {:>3}  {:>7.3f} {:>7.3f} {:>6.1f}  ", number, row.number("x"),
                                 row.number("y"), degrees(wrap_angle(row.number("heading_rad"))));
  const std::string outcome = outcome_of(row);
  if (outcome == "passed" || outcome == "missed") {
    return fmt::format("{}{}, {:.1f} mm off\n", text, outcome == "passed" ? "passed by" : "missed",
                       1e3 * row.number("nearest_m"));
  }
  if (outcome != "reached") return fmt::format("{}{}\n", text, outcome);
  return text + fmt::format("{:>6.1f}  {:>8.1f} {:>8.1f} {:>8.2f}\n", row.number("reached_s"),
                            1e3 * row.number("dx"), 1e3 * row.number("dy"), degrees(row.number("dtheta")));
}

/// Returns a length or an angle and its ratio to the least possible one.
std::string ratio_line(std::string_view name, double value, std::string_view unit, double least,
                       std::string_view of) {
  constexpr double no_motion = 1e-6;
  std::string text = fmt::format("  {:<9}  {:.3f} {}", name, value, unit);
  if (least > no_motion) text += fmt::format(", {:.3f} times the {}", value / least, of);
  return text + "\n";
}

}  // namespace

std::string drive_summary(const Report& report) {
  const Table& waypoints = table_named(report, "waypoints");
  const std::string loop = setting(report, "loop");
  std::size_t stops = 0, reached = 0, unconfirmed = 0;
  for (const auto& values : waypoints.rows) {
    const TableRow row{waypoints, values};
    if (row.number("stop") == 0.0) continue;
    ++stops;
    const std::string outcome = outcome_of(row);
    reached += outcome == "reached" ? 1 : 0;
    unconfirmed += outcome == "unconfirmed" ? 1 : 0;
  }
  std::string text = fmt::format("{}, {}: {} of {} stops reached", printable(report.world_name),
                                 loop == "laser" ? "by laser" : loop + " loop", reached, stops);
  if (unconfirmed > 0) text += fmt::format(", {} unconfirmed,", unconfirmed);
  text += fmt::format(" in {}\n\n", duration_text(metric(report, "time_s")));
  text += "       x, m    y, m     deg       s  off x, mm    y, mm      deg\n";
  for (std::size_t i = 0; i < waypoints.rows.size(); ++i)
    text += stop_line(i + 1, {waypoints, waypoints.rows[i]});
  text += '\n';
  text += ratio_line("driven", metric(report, "driven_m"), "m", metric(report, "ideal_m"), "straight legs");
  text += ratio_line("turned", metric(report, "turned_rad"), "rad", metric(report, "ideal_rad"), "least");
  if (std::isfinite(metric(report, "ideal_s")))
    text += fmt::format("  time       {:.1f} s, ideal {:.1f} s\n", metric(report, "time_s"),
                        metric(report, "ideal_s"));
  if (std::isfinite(metric(report, "clearance_m")))
    text += fmt::format("  clearance  {:.3f} m at least\n", metric(report, "clearance_m"));
  if (std::isfinite(metric(report, "path_m"))) {
    text += fmt::format("  path       {:.3f} m, {:.3f} m clear\n", metric(report, "path_m"),
                        metric(report, "path_clearance_m"));
  }
  if (loop == "closed") {
    text += fmt::format("  tags       of use in {:.0f} % of the images\n",
                        100.0 * metric(report, "tag_fraction"));
  }
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

}  // namespace outrider
