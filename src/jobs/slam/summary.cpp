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
  const ReportSlam& slam = *report.slam;
  const double end_s = report.track.empty() ? 0.0 : report.track.back().time_s;
  std::string text = fmt::format("{}: {:.1f} m in {}, mapped by {}\n\n", printable(report.world_name),
                                 metric(report, "distance_m"), duration_text(end_s), slam.engine);
  text += fmt::format(
      "  map        {} landmarks, {} loops closed{}\n", slam.landmarks.size(), slam.loops.size(),
      slam.map
          ? fmt::format(", {} x {} cells of {:.3g} m", slam.map->columns, slam.map->rows, slam.map->cell_m)
          : std::string());
  if (const double nodes = metric(report, "nodes"); std::isfinite(nodes)) {
    text +=
        fmt::format("  graph      {:.0f} nodes, {:.0f} edges: from a cost of {:.6g} in {:.0f} steps\n", nodes,
                    metric(report, "edges"), metric(report, "start_cost"), metric(report, "steps"));
  }
  text += line(report, "cost", "cost", "{:.6g}");
  text +=
      line(report, "landmark_rmse_aligned_m", "landmarks", "off the truth by {:.3f} m, once laid over it");
  text += line(report, "mean_absolute_error_m", "way", "off the reference by {:.3f} m on average");
  if (!report.reason.empty()) text += fmt::format("\n  {}\n", printable(report.reason));
  return text;
}

}  // namespace outrider
