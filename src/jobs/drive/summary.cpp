#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

std::string stop_line(std::size_t number, const TableRow& row) {
  std::string text = fmt::format("  {:>3}  {:>7.3f} {:>7.3f} {:>6.1f}  ", number, row.number("x"),
                                 row.number("y"), degrees(wrap_angle(row.number("heading_rad"))));
  if (row.number("stop") == 0.0) return text + "passed by\n";
  if (std::isnan(row.number("reached_s"))) return text + "not reached\n";
  return text + fmt::format("{:>6.1f}  {:>8.1f} {:>8.1f} {:>8.2f}\n", row.number("reached_s"),
                            1e3 * row.number("dx"), 1e3 * row.number("dy"), degrees(row.number("dtheta")));
}

}  // namespace

std::string drive_summary(const Report& report) {
  const Table& waypoints = table_named(report, "waypoints");
  const std::string loop = setting(report, "loop");
  std::size_t stops = 0, reached = 0;
  for (const auto& values : waypoints.rows) {
    const TableRow row{waypoints, values};
    stops += row.number("stop") == 0.0 ? 0 : 1;
    reached += std::isnan(row.number("reached_s")) ? 0 : 1;
  }
  std::string text =
      fmt::format("{}, {} loop: {} of {} stops reached in {}\n\n", printable(report.world_name), loop,
                  reached, stops, duration_text(metric(report, "time_s")));
  text += "       x, m    y, m     deg       s  off x, mm    y, mm      deg\n";
  for (std::size_t i = 0; i < waypoints.rows.size(); ++i)
    text += stop_line(i + 1, {waypoints, waypoints.rows[i]});
  text += fmt::format("\n  driven     {:.3f} m, {:.3f} times the straight legs\n", metric(report, "driven_m"),
                      metric(report, "driven_m") / std::max(metric(report, "ideal_m"), 1e-9));
  text += fmt::format("  turned     {:.3f} rad, {:.3f} times the least\n", metric(report, "turned_rad"),
                      metric(report, "turned_rad") / std::max(metric(report, "ideal_rad"), 1e-9));
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
