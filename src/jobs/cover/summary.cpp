#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
std::string cover_summary(const Report& report) {
  const auto value = [&](std::string_view name) { return metric(report, name); };
  std::string text = fmt::format("{}: {:.3f} % covered in {}\n\n", printable(report.world_name),
                                 100.0 * value("covered_fraction"), duration_text(value("time_s")));
  text += fmt::format("  area      {:.6g} m2, of which a disk of {:g} m reaches {:.6g} m2\n",
                      value("area_m2"), value("strip_m"), value("reach_m2"));
  if (std::isfinite(value("origin_x")))
    text += fmt::format(
        "  frame     of positions here: metres east and north of ({:.9g}, {:.9g}), the files have the "
        "area's\n",
        value("origin_x"), value("origin_y"));
  text += fmt::format("  track     {}: {:.2f} m, {:.0f} stops; {:.0f} laps, {:.0f} cells, {:.0f} lanes\n",
                      setting(report, "method"), value("planned_m"), value("stops"), value("laps"),
                      value("cells"), value("lanes"));
  if (value("areas_apart") > 1.0)
    text += fmt::format("  areas     {:.0f}, with {:.2f} m of transfers over the ground between them\n",
                        value("areas_apart"), value("transfer_m"));
  const Table& areas = table_named(report, "areas");
  for (const auto& values : areas.rows) {
    const TableRow row{areas, values};
    text +=
        fmt::format("  area {:<4.0f} {:.6g} m2, {:.3f} % of its reach covered, {:.3f} % surely off the rim\n",
                    row.number("area"), row.number("area_m2"), 100.0 * row.number("planned_fraction"),
                    100.0 * row.number("sure_inner_fraction"));
  }
  text +=
      fmt::format("  covered   {:.3f} % of the reach, {:.3g} m2 missed, {:.3g} m2 overlap\n",
                  100.0 * value("planned_fraction"), value("planned_missed_m2"), value("planned_overlap_m2"));
  const std::string bounds =
      std::isfinite(value("t_min_s"))
          ? fmt::format("{} to {}, ", duration_text(value("t_min_s")), duration_text(value("t_max_s")))
          : std::string();
  text += fmt::format("  time      {}at full speed {}\n", bounds, duration_text(value("planned_s")));
  text += fmt::format(
      "  surely    {:.3f} % of the reach and {:.3f} % of it off the rim, with a tracking error of {:g} m\n",
      100.0 * value("sure_fraction"), 100.0 * value("sure_inner_fraction"), value("tracking_error_limit_m"));
  text += fmt::format("  driven    {} with seed {}, {:.3f} % covered\n", duration_text(value("time_s")),
                      setting(report, "seed"), 100.0 * value("covered_fraction"));
  if (std::isfinite(value("reachable_fraction")))
    text += fmt::format(
        "  among     things: {:.3f} % of the {:.6g} m2 that it can reach, {:.0f} contacts, {:.0f} times "
        "planned again\n",
        100.0 * value("reachable_fraction"), value("reachable_m2"), value("contacts"), value("rounds"));
  if (report.status == "not_done") text += fmt::format("  not done  {}\n", report.reason);
  return text;
}

}  // namespace outrider
