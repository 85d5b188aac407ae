#include "guard_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cli {
namespace {

double metric(const Report& report, const std::string& name) {
  const auto found = std::find_if(report.metrics.begin(), report.metrics.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found == report.metrics.end() ? 0.0 : found->second;
}

std::string target_row(const ReportTarget& target, std::size_t width) {
  if (target.shots == 0) {
    return fmt::format("  {:<{}}  {:<11}  {}\n", target.name, width, target.status, target.reason);
  }
  return fmt::format("  {:<{}}  {:<11}  {:>5}  {:>6.1f}  {:>15}  {:>6.1f}  {:>6.1f}  {:>7.2f}\n", target.name,
                     width, target.status, target.shots, target.done_s,
                     fmt::format("({:.2f}, {:.2f})", target.pose.position.x, target.pose.position.y),
                     degrees(target.pitch_rad), target.speed_mps, target.clearance_m);
}

}  // namespace

std::string summary(const Report& report) {
  std::string text = fmt::format("{}: {:.0f} of {:.0f} targets reached in {}\n\n", report.world_name,
                                 metric(report, "reached"), metric(report, "targets"),
                                 duration_text(metric(report, "mission_s")));
  std::size_t width = 6;
  for (const ReportTarget& target : report.targets) width = std::max(width, target.name.size());
  text += fmt::format("  {:<{}}  {:<11}  {:>5}  {:>6}  {:>15}  {:>6}  {:>6}  {:>7}\n", "target", width,
                      "status", "shots", "at s", "from m", "pitch", "m/s", "clear m");
  for (const ReportTarget& target : report.targets) text += target_row(target, width);
  text += fmt::format(
      "\n  drove {:.1f} m, turned {:.0f} degrees, fired {:.0f} shots from {:.0f} stops\n"
      "  planned {}; at this resolution no mission is shorter than {}\n",
      metric(report, "driven_m"), degrees(metric(report, "turned_rad")), metric(report, "shots"),
      metric(report, "stops"), duration_text(metric(report, "planned_s")),
      duration_text(metric(report, "lower_bound_s")));
  return text;
}

nlohmann::ordered_json summary_json(const Report& report, double planning_s, const std::string& report_path) {
  nlohmann::ordered_json metrics;
  for (const auto& [name, value] : report.metrics) {
    if (name == "mission_s") metrics["planning_s"] = planning_s;
    value == std::floor(value) ? metrics[name] = static_cast<std::int64_t>(value) : metrics[name] = value;
  }
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (const ReportTarget& t : report.targets) {
    targets.push_back({{"name", t.name},
                       {"status", t.status},
                       {"reason", t.reason},
                       {"pose", {t.pose.position.x, t.pose.position.y, t.pose.heading_rad}},
                       {"pitch_rad", t.pitch_rad},
                       {"yaw_rad", t.shot_yaw_rad},
                       {"speed_mps", t.speed_mps},
                       {"clearance_m", t.clearance_m}});
  }
  return {{"status", report.status}, {"job", report.job},  {"reason", report.reason},
          {"metrics", metrics},      {"targets", targets}, {"report", report_path}};
}

}  // namespace outrider::cli
