#include "guard_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cli {
namespace {

bool has_metric(const Report& report, std::string_view name) { return !std::isnan(metric(report, name)); }

std::string watch_summary(const Report& report) {
  return fmt::format(
      "\n  drove {:.1f} m, fired {:.0f} shots, planned {:.0f} times\n"
      "  intruders were inside for {:.1f} s in all, {:.1f} s at most; no policy makes it less than {:.1f} s\n"
      "  the last was hit after {}; no policy makes it less than {}\n",
      metric(report, "driven_m"), metric(report, "shots"), metric(report, "plans"),
      metric(report, "intruder_seconds"), metric(report, "longest_s"),
      metric(report, "intruder_seconds_bound"), duration_text(metric(report, "makespan_s")),
      duration_text(metric(report, "makespan_bound_s")));
}

std::string hunt_summary(const Report& report) {
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

std::string passing_lines(const Report& report) {
  std::string text = fmt::format("  {:.0f} of the shots left while the robot drove, {:.0f} of these hit\n",
                                 metric(report, "shots_in_passing"), metric(report, "hits_in_passing"));
  const double bound_s = metric(report, "lower_bound_s");
  if (bound_s > 0.0) {
    text += fmt::format("  no mission, shooting from rest or on the move, takes less than {}\n",
                        duration_text(bound_s));
  }
  return text;
}

std::string target_row(const ReportTarget& target, std::size_t width) {
  if (target.shots == 0) {
    return fmt::format("  {:<{}}  {:<11}  {}\n", printable(target.name), width, printable(target.status),
                       printable(target.reason));
  }
  return fmt::format("  {:<{}}  {:<11}  {:>5}  {:>6.1f}  {:>15}  {:>6.1f}  {:>6.1f}  {:>7.2f}\n",
                     printable(target.name), width, target.status, target.shots, target.done_s,
                     fmt::format("({:.2f}, {:.2f})", target.pose.position.x, target.pose.position.y),
                     degrees(target.pitch_rad), target.speed_mps, target.clearance_m);
}

/// Counts without a decimal point.
nlohmann::ordered_json number_json(double value) {
  constexpr double exact = 1e15;
  if (std::abs(value) < exact && value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

nlohmann::ordered_json target_json(const ReportTarget& t) {
  nlohmann::ordered_json object = {{"name", t.name}, {"status", t.status}, {"reason", t.reason}};
  if (t.shots == 0) {
    for (const char* key : {"pose", "pitch_rad", "yaw_rad", "speed_mps", "clearance_m"})
      object[key] = nullptr;
    return object;
  }
  object["pose"] = {t.pose.position.x, t.pose.position.y, t.pose.heading_rad};
  object["pitch_rad"] = t.pitch_rad;
  object["yaw_rad"] = t.shot_yaw_rad;
  object["speed_mps"] = t.speed_mps;
  object["clearance_m"] = t.clearance_m;
  return object;
}

/// How far the plan may be from the best, among the stops offered and from anywhere.
std::string bounds_lines(const Report& report) {
  return fmt::format(
      "  no tour of the {:.0f} stops offered takes less than {}: a gap of {:.1f} %{}\n"
      "  no mission from any place of the grid takes less than {}: a gap of {:.1f} %\n",
      metric(report, "stops_offered"), duration_text(metric(report, "lower_bound_s")),
      100.0 * metric(report, "gap"), metric(report, "tour_proven") > 0.0 ? ", the tour is the best" : "",
      duration_text(metric(report, "anywhere_lower_bound_s")), 100.0 * metric(report, "anywhere_gap"));
}

}  // namespace

std::string summary(const Report& report) {
  std::string text = fmt::format("{}: {:.0f} of {:.0f} targets reached in {}\n\n",
                                 printable(report.world_name), metric(report, "reached"),
                                 metric(report, "targets"), duration_text(metric(report, "mission_s")));
  std::size_t width = 6;
  for (const ReportTarget& target : report.targets) width = std::max(width, target.name.size());
  text += fmt::format("  {:<{}}  {:<11}  {:>5}  {:>6}  {:>15}  {:>6}  {:>6}  {:>7}\n", "target", width,
                      "status", "shots", "at s", "from m", "pitch", "m/s", "clear m");
  for (const ReportTarget& target : report.targets) text += target_row(target, width);
  if (has_metric(report, "expected_hits")) return text + hunt_summary(report);
  if (has_metric(report, "intruder_seconds")) return text + watch_summary(report);
  text += fmt::format(
      "\n  drove {:.1f} m, turned {:.0f} degrees, fired {:.0f} shots from {:.0f} stops\n"
      "  planned {}\n",
      metric(report, "driven_m"), degrees(metric(report, "turned_rad")), metric(report, "shots"),
      metric(report, "stops"), duration_text(metric(report, "planned_s")));
  if (has_metric(report, "stops_offered") && metric(report, "stops_offered") > 0.0)
    text += bounds_lines(report);
  if (has_metric(report, "fills")) text += supply_line(report);
  if (has_metric(report, "shots_in_passing")) text += passing_lines(report);
  return text;
}

nlohmann::ordered_json summary_json(const Report& report, const std::string& report_path) {
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
  for (const auto& [name, value] : report.metrics) metrics[name] = number_json(value);
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (const ReportTarget& target : report.targets) targets.push_back(target_json(target));
  nlohmann::ordered_json path = nullptr;
  if (!report_path.empty()) path = report_path;
  nlohmann::ordered_json object = {
      {"status", report.status}, {"job", report.job}, {"reason", report.reason},    {"metrics", metrics},
      {"targets", targets},      {"report", path},    {"warnings", report.warnings}};
  if (report.sim) object["sim"] = *report.sim;
  return object;
}

void insert_planning(nlohmann::ordered_json& summary, double planning_s) {
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
  for (const auto& [name, value] : summary["metrics"].items()) {
    if (name == "mission_s") metrics["planning_s"] = planning_s;
    metrics[name] = value;
  }
  summary["metrics"] = std::move(metrics);
}

}  // namespace outrider::cli
