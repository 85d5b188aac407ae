#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

/// Returns a line with a metric, if it is known.
std::string line(const Report& report, const char* name, const char* word, const char* sentence) {
  const double value = metric(report, name);
  if (!std::isfinite(value)) return {};
  return fmt::format("  {:<10} {}\n", word, fmt::format(fmt::runtime(sentence), value));
}

}  // namespace

std::string slam_summary(const Report& report) {
  const auto value = [&](const char* name) { return metric(report, name); };
  std::string text = fmt::format("{}: {:.1f} m in {}\n\n", printable(report.world_name), value("distance_m"),
                                 duration_text(value("run_s")));
  text += line(report, "map_m2", "map", "{:.1f} m2 of free floor");
  if (std::isfinite(value("steps_located"))) {
    text += fmt::format("  located    at {:.0f} of {:.0f} scans, lost {:.0f} times\n", value("steps_located"),
                        value("steps"), value("times_lost"));
  }
  text += line(report, "landmarks", "landmarks", "{:.0f}");
  text += line(report, "loops", "loops", "{:.0f} closed");
  if (std::isfinite(value("nodes"))) {
    text += fmt::format("  graph      {:.0f} nodes, {:.0f} edges: from a cost of {:.6g} in {:.0f} steps\n",
                        value("nodes"), value("edges"), value("start_cost"), value("steps"));
  }
  text += line(report, "cost", "cost", "{:.6g}");
  if (value("cost_bound") > 0.0)
    text += line(report, "cost_bound", "proven", "no poses cost less than {:.6g}");
  if (value("edges_refused") > 0.0) text += line(report, "edges_refused", "refused", "{:.0f} edges");
  text += line(report, "landmark_rmse_aligned_m", "truth", "landmarks off by {:.3f} m, once laid over it");
  text += line(report, "mean_absolute_error_m", "reference", "the way is off by {:.3f} m on average");
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

}  // namespace outrider
