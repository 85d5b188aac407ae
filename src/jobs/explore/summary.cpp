#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {

std::string explore_summary(const Report& report) {
  const auto value = [&](std::string_view name) { return metric(report, name); };
  std::string text =
      fmt::format("{}: {:.2f} % of the {:.1f} m2 that can be seen is mapped free in {}, on {:.1f} m\n\n",
                  printable(report.world_name), 100.0 * value("explored_fraction"), value("seeable_m2"),
                  duration_text(value("time_s")), value("distance_m"));
  text += fmt::format("  map        off by {:.3f} m on average\n", value("map_error_m"));
  const double longest_s = value("max_decision_s");
  text += fmt::format(
      "  thinking   {:.0f} decisions{}\n", value("decisions"),
      std::isfinite(longest_s) ? fmt::format(", {:.1f} ms the longest", 1e3 * longest_s) : std::string());
  text += fmt::format("  home       {}, {:.3f} m from the start; its pose is wrong by {:.3f} m\n",
                      value("returned_home") > 0.0 ? "reached" : "not reached", value("home_error_m"),
                      value("pose_error_m"));
  text += fmt::format("  touched    {:.0f} times; stuck {:.0f} times\n", value("contacts"), value("stuck"));
  const Table& left = table_named(report, "left_over");
  for (const auto& values : left.rows) {
    const TableRow row{left, values};
    text += fmt::format("  left over  frontier at ({:.2f}, {:.2f}): {}\n", row.number("x"), row.number("y"),
                        printable(row.text("reason")));
  }
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

}  // namespace outrider
