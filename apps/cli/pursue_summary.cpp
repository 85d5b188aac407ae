#include "pursue_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"

namespace outrider::cli {
namespace {

nlohmann::ordered_json number_json(double value) {
  constexpr double exact = 9e15;
  if (!std::isfinite(value)) return nullptr;
  if (std::abs(value) < exact && value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

/// How good the cost is.
std::string verdict(const Report& report) {
  const double cost = metric(report, "cost"), bound = metric(report, "lower_bound");
  if (metric(report, "optimal") == 1.0) return "proven: no catch costs less";
  if (!(bound > 0.0)) return "no bound is known";
  if (metric(report, "caught") == 0.0) return fmt::format("a catch would have cost at least {:.0f}", bound);
  return fmt::format("{:.2f} % above {:.0f}, below which no catch is", 100.0 * (cost / bound - 1.0), bound);
}

}  // namespace

std::string pursuit_summary(const Report& report) {
  if (metric(report, "caught") == 0.0) {
    std::string text =
        fmt::format("{}: not caught\n\n  {}\n", printable(report.world_name), printable(report.reason));
    if (std::isfinite(metric(report, "cost"))) {
      text += fmt::format("  paid      {:.0f}; {}\n", metric(report, "cost"), verdict(report));
    }
    return text;
  }
  std::string text = fmt::format("{}: caught in second {:.0f} for {:.0f}\n\n", printable(report.world_name),
                                 metric(report, "catch_time_s"), metric(report, "cost"));
  text += fmt::format("  cost      {:.0f}; {}\n", metric(report, "cost"), verdict(report));
  text += fmt::format("  moves     {:.0f}, and {:.0f} s of waiting\n", metric(report, "moves"),
                      metric(report, "catch_time_s") - metric(report, "moves"));
  if (metric(report, "earliest_catch_s") >= 0.0) {
    text += fmt::format("  earliest  second {:.0f} is the first in which a catch is possible\n",
                        metric(report, "earliest_catch_s"));
  }
  if (metric(report, "robots") > 1.0) {
    text += fmt::format("  team      robot {:.0f} of {:.0f} made the catch, {:.0f} handovers\n",
                        metric(report, "catcher"), metric(report, "robots"), metric(report, "handovers"));
  }
  return text;
}

std::string times_text(const PursuitTimes& times) {
  const std::string first = times.first_feasible_s < 0.0
                                ? std::string("no catch was found")
                                : fmt::format("a first catch after {:.1f} ms", 1e3 * times.first_feasible_s);
  return fmt::format("  planning  {:.1f} ms, {}; {:.0f} MiB\n", 1e3 * times.planning_s, first,
                     times.peak_mib);
}

nlohmann::ordered_json pursuit_json(const Report& report, const std::string& report_path) {
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
  for (const auto& [name, value] : report.metrics) {
    const bool flag = name == "caught" || name == "optimal";
    metrics[name] = flag ? nlohmann::ordered_json(value == 1.0) : number_json(value);
  }
  nlohmann::ordered_json path = nullptr;
  if (!report_path.empty()) path = report_path;
  return {{"status", report.status}, {"job", report.job}, {"reason", report.reason},
          {"metrics", metrics},      {"report", path},    {"warnings", report.warnings}};
}

void insert_times(nlohmann::ordered_json& summary, const PursuitTimes& times) {
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
  for (const auto& [name, value] : summary["metrics"].items()) {
    metrics[name] = value;
    if (name != "earliest_catch_s") continue;
    metrics["first_feasible_s"] = nullptr;
    if (times.first_feasible_s >= 0.0) metrics["first_feasible_s"] = times.first_feasible_s;
    metrics["planning_s"] = times.planning_s;
    metrics["peak_mib"] = times.peak_mib;
  }
  summary["metrics"] = std::move(metrics);
}

}  // namespace outrider::cli
