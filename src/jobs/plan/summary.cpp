#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

/// The values of a row by the names of their columns.
struct RowReader {
  const Table& table;
  const std::vector<TableValue>& values;

  template <class Value>
  [[nodiscard]] const Value& get(std::string_view column) const {
    const auto found = std::find(table.columns.begin(), table.columns.end(), column);
    return std::get<Value>(values.at(static_cast<std::size_t>(found - table.columns.begin())));
  }
  [[nodiscard]] double number(std::string_view column) const { return get<double>(column); }
  [[nodiscard]] const std::string& text(std::string_view column) const { return get<std::string>(column); }
};

std::string head(bool numbered) {
  return fmt::format("  {}{:<26} {:>11} {:>11} {:>11} {:<4} {:>8} {:>9} {:>5} {:>10} {:>10}{}\n",
                     numbered ? "query  " : "", "planner", "length m", "cost", "bound", "", "clear m",
                     "exposure", "legs", "expansions", "ms", numbered ? "  goal" : "");
}

std::string line(const RowReader& row, bool numbered) {
  const Vec2 to = row.get<Vec2>("to");
  const std::string goal = numbered ? fmt::format("  {:g},{:g}", to.x, to.y) : "";
  const std::string before =
      fmt::format("  {}{:<26}", numbered ? fmt::format("{:>5.0f}  ", row.number("query")) : "",
                  printable(row.text("planner")));
  if (row.text("status") != "done")
    return fmt::format("{} {}{}\n", before, printable(row.text("reason")), goal);
  const std::size_t points = row.get<std::vector<Vec2>>("waypoints").size();
  return fmt::format("{} {:>11.3f} {:>11.3f} {:>11.3f} {:<4} {:>8.3f} {:>9.3f} {:>5} {:>10.0f} {:>10.2f}{}\n",
                     before, row.number("length_m"), row.number("cost"), row.number("lower_bound"),
                     row.text("cost_unit"), row.number("clearance_m"), row.number("exposure"),
                     points == 0 ? 0 : points - 1, row.number("expansions"), 1e3 * row.number("time_s"),
                     goal);
}

}  // namespace

std::string plan_summary(const Report& report) {
  std::string text = fmt::format("{}: {:.0f} of {:.0f} paths found", printable(report.world_name),
                                 metric(report, "paths"), metric(report, "rows"));
  const double length_m = metric(report, "length_m");
  if (std::isfinite(length_m)) {
    text += fmt::format(", {} {:.3f} m with {:.3f} m clearance",
                        metric(report, "rows") > 1.0 ? "the shortest" : "it is", length_m,
                        metric(report, "clearance_m"));
  }
  text += "\n";
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

std::string plan_run_summary(const Run& run) {
  if (run.tables.empty()) return plan_summary(run.report);
  const Table& table = run.tables.front();
  const bool numbered = std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& values) {
    return std::isfinite(RowReader{table, values}.number("query"));
  });
  std::string text = head(numbered);
  for (const auto& values : table.rows) text += line({table, values}, numbered);
  return text;
}

}  // namespace outrider
