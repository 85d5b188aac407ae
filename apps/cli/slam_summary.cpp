#include "slam_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"

namespace outrider::cli {
namespace {

/// A line of a metric, where it is known.
std::string line(const Report& report, const char* name, const char* word, const char* sentence) {
  const double value = metric(report, name);
  if (!std::isfinite(value)) return {};
  return fmt::format("  {:<10} {}\n", word, fmt::format(fmt::runtime(sentence), value));
}

}  // namespace

std::string slam_summary(const Report& report) {
  const ReportSlam& slam = *report.slam;
  const double end_s = report.track.empty() ? 0.0 : report.track.back().time_s;
  std::string text = fmt::format("{}: {:.1f} m in {}, mapped by {}\n\n", printable(report.world_name),
                                 metric(report, "distance_m"), duration_text(end_s), slam.engine);
  text += fmt::format(
      "  map        {} landmarks, {} loops closed{}\n", slam.landmarks.size(), slam.loops.size(),
      slam.map
          ? fmt::format(", {} x {} cells of {:.3g} m", slam.map->columns, slam.map->rows, slam.map->cell_m)
          : std::string());
  text += line(report, "cost", "cost", "{:.6g}");
  text +=
      line(report, "landmark_rmse_aligned_m", "landmarks", "off the truth by {:.3f} m, once laid over it");
  text += line(report, "mean_absolute_error_m", "way", "off the reference by {:.3f} m on average");
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

nlohmann::ordered_json slam_json(const Report& report, const std::string& report_path) {
  nlohmann::ordered_json object = {{"status", report.status},
                                   {"job", report.job},
                                   {"reason", report.reason},
                                   {"engine", report.slam->engine}};
  for (const auto& [name, value] : report.metrics) {
    object[name] = nullptr;
    if (std::isfinite(value)) object[name] = value;
  }
  object["report"] = report_path;
  object["warnings"] = report.warnings;
  return object;
}

}  // namespace outrider::cli
