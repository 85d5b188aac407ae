#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

std::string stop_line(std::size_t number, const ReportStop& stop) {
  const Vec2 at = stop.pose.position;
  std::string text = fmt::format("  {:>3}  {:>7.3f} {:>7.3f} {:>6.1f}  ", number, at.x, at.y,
                                 degrees(wrap_angle(stop.pose.heading_rad)));
  if (!stop.stop) return text + "passed by\n";
  if (std::isnan(stop.time_s)) return text + "not reached\n";
  return text + fmt::format("{:>6.1f}  {:>8.1f} {:>8.1f} {:>8.2f}\n", stop.time_s, 1e3 * stop.error.x,
                            1e3 * stop.error.y, degrees(stop.heading_error_rad));
}

}  // namespace

std::string drive_summary(const Report& report) {
  const ReportDrive& drive = *report.drive;
  std::size_t stops = 0, reached = 0;
  for (const ReportStop& stop : drive.stops) {
    stops += stop.stop ? 1 : 0;
    reached += std::isnan(stop.time_s) ? 0 : 1;
  }
  std::string text =
      fmt::format("{}, {} loop: {} of {} stops reached in {}\n\n", printable(report.world_name), drive.loop,
                  reached, stops, duration_text(metric(report, "time_s")));
  text += "       x, m    y, m     deg       s  off x, mm    y, mm      deg\n";
  for (std::size_t i = 0; i < drive.stops.size(); ++i) text += stop_line(i + 1, drive.stops[i]);
  text += fmt::format("\n  driven     {:.3f} m, {:.3f} times the straight legs\n", metric(report, "driven_m"),
                      metric(report, "driven_m") / std::max(metric(report, "ideal_m"), 1e-9));
  text += fmt::format("  turned     {:.3f} rad, {:.3f} times the least\n", metric(report, "turned_rad"),
                      metric(report, "turned_rad") / std::max(metric(report, "ideal_rad"), 1e-9));
  text += fmt::format("  clearance  {:.3f} m at least\n", metric(report, "clearance_m"));
  if (std::isfinite(metric(report, "path_m"))) {
    text += fmt::format("  path       {:.3f} m, {:.3f} m clear\n", metric(report, "path_m"),
                        metric(report, "path_clearance_m"));
  }
  if (drive.loop == "closed") {
    text += fmt::format("  tags       of use in {:.0f} % of the images\n",
                        100.0 * metric(report, "tag_fraction"));
  }
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

std::vector<Table> drive_tables(const Report& report) {
  Table table{"waypoints", {"dx", "dy", "dtheta"}, {}};
  for (const ReportStop& stop : report.drive->stops) {
    const auto if_reached = [&](double value) { return std::isnan(stop.time_s) ? std::nan("") : value; };
    table.rows.push_back(
        {if_reached(stop.error.x), if_reached(stop.error.y), if_reached(stop.heading_error_rad)});
  }
  return {std::move(table)};
}

}  // namespace outrider
