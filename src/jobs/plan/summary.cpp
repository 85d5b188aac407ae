#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

std::string head(bool numbered) {
  return fmt::format("  {}{:<26} {:>11} {:>9} {:>11} {:>11} {:<4} {:>8} {:>9} {:>5} {:>10} {:>10}{}\n",
                     numbered ? "query  " : "", "planner", "length m", "drive s", "cost", "bound", "",
                     "clear m", "exposure", "legs", "expansions", "ms", numbered ? "  goal" : "");
}

/// Returns a processing time in milliseconds; "-" if it was not stored.
std::string milliseconds_text(double time_s) {
  return std::isfinite(time_s) ? fmt::format("{:.2f}", 1e3 * time_s) : "-";
}

std::string line(const TableRow& row, bool numbered) {
  const Vec2 to = row.get<Vec2>("to");
  const std::string goal = numbered ? fmt::format("  {:g},{:g}", to.x, to.y) : "";
  const std::string before =
      fmt::format("  {}{:<26}", numbered ? fmt::format("{:>5.0f}  ", row.number("query")) : "",
                  printable(row.text("planner")));
  if (row.text("status") != "done")
    return fmt::format("{} {}{}\n", before, printable(row.text("reason")), goal);
  const std::size_t points = row.get<std::vector<Vec2>>("waypoints").size();
  return fmt::format(
      "{} {:>11.3f} {:>9.2f} {:>11.3f} {:>11.3f} {:<4} {:>8.3f} {:>9.3f} {:>5} {:>10.0f} {:>10}{}\n", before,
      row.number("length_m"), row.number("drive_s"), row.number("cost"), row.number("lower_bound"),
      row.text("cost_unit"), row.number("clearance_m"), row.number("exposure"), points == 0 ? 0 : points - 1,
      row.number("expansions"), milliseconds_text(row.number("time_s")), goal);
}

}  // namespace

std::string plan_summary(const Report& report) {
  const Table& table = table_named(report, "rows");
  const bool numbered = std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& values) {
    return std::isfinite(TableRow{table, values}.number("query"));
  });
  std::string text = head(numbered);
  for (const auto& values : table.rows) text += line({table, values}, numbered);
  return text;
}

}  // namespace outrider
