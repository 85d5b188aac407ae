#include "explore_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"

namespace outrider::cli {

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
  text += fmt::format("  home       {}, where it is wrong by {:.3f} m\n",
                      value("returned_home") > 0.0 ? "reached" : "not reached", value("home_error_m"));
  text += fmt::format("  touched    {:.0f} times; stuck {:.0f} times\n", value("contacts"), value("stuck"));
  for (const ReportRefusal& refusal : report.explore->refused) {
    text += fmt::format("  left out   frontier at ({:.2f}, {:.2f}): {}\n", refusal.position.x,
                        refusal.position.y, printable(refusal.reason));
  }
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

nlohmann::ordered_json explore_json(const Report& report, const std::string& stop_reason,
                                    const std::string& report_path) {
  nlohmann::ordered_json object = {{"status", report.status},
                                   {"job", report.job},
                                   {"stop_reason", stop_reason},
                                   {"reason", report.reason}};
  for (const auto& [name, value] : report.metrics) {
    object[name] = nullptr;
    if (name == "returned_home") {
      object[name] = value > 0.0;
    } else if (name == "decisions" || name == "contacts" || name == "stuck" || name == "bad_scans" ||
               name == "loops") {
      object[name] = static_cast<std::int64_t>(value);
    } else if (std::isfinite(value)) {
      object[name] = value;
    }
  }
  for (const auto& [name, value] : report.machine_times) object[name] = value;
  auto refused = nlohmann::ordered_json::array();
  for (const ReportRefusal& refusal : report.explore->refused) {
    refused.push_back({{"x", refusal.position.x}, {"y", refusal.position.y}, {"reason", refusal.reason}});
  }
  object["refused"] = std::move(refused);
  object["report"] = nullptr;
  if (!report_path.empty()) object["report"] = report_path;
  object["warnings"] = report.warnings;
  return object;
}

}  // namespace outrider::cli
