#include "faults/truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double farthest_m = 1.0;

/// Returns the cells in which the beams of a recording end.
Grid<std::uint8_t> beam_ends(const GridFrame& frame, const LaserLog& recorded, const Pose2& map_T_reference,
                             const Pose2& robot_T_laser) {
  Grid<std::uint8_t> ends(frame);
  for (std::size_t i = 0; i < recorded.reference.size(); ++i) {
    const LaserScan& scan = recorded.steps[i].scan;
    const Pose2 map_T_laser = compose(compose(map_T_reference, recorded.reference[i]), robot_T_laser);
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const auto range_m = static_cast<double>(scan.ranges_m[beam]);
      if (!(range_m >= scan.least_m && range_m <= scan.most_m)) continue;
      const double bearing_rad = scan.first_rad + static_cast<double>(beam) * scan.step_rad;
      const Cell cell = frame.cell_at(map_T_laser * (range_m * direction(bearing_rad)));
      if (ends.contains(cell)) ends[cell] = 1;
    }
  }
  return ends;
}

/// Returns the distance from a cell to the nearest marked one, at most `farthest_m`.
double distance_to_marked(const Grid<std::uint8_t>& marked, Cell from) {
  const double cell_m = marked.frame.resolution_m;
  double nearest_m = farthest_m;
  for (int ring = 0; ring * cell_m < nearest_m; ++ring) {
    for (int y = -ring; y <= ring; ++y) {
      const int step = std::abs(y) == ring || ring == 0 ? 1 : 2 * ring;
      for (int x = -ring; x <= ring; x += step) {
        const Cell cell{from.x + x, from.y + y};
        if (marked.contains(cell) && marked[cell] != 0)
          nearest_m = std::min(nearest_m, cell_m * std::hypot(x, y));
      }
    }
  }
  return nearest_m;
}

}  // namespace

double wall_error_m(const Grid<std::uint8_t>& occupancy, const LaserLog& recorded,
                    const Pose2& map_T_reference, const Pose2& robot_T_laser) {
  const Grid<std::uint8_t> ends = beam_ends(occupancy.frame, recorded, map_T_reference, robot_T_laser);
  double sum_m = 0.0;
  std::size_t walls = 0;
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    if (occupancy.cells[i] != occupied_cell) continue;
    sum_m += distance_to_marked(ends, occupancy.frame.cell(i));
    ++walls;
  }
  return walls == 0 ? std::numeric_limits<double>::quiet_NaN() : sum_m / static_cast<double>(walls);
}

void judge_by_truth(Report& report, std::size_t changes) {
  struct Limit {
    const char* metric;
    double most_m;
  };
  constexpr std::array limits = {Limit{"ate_m", 0.25}, Limit{"landmark_rmse_aligned_m", 0.1},
                                 Limit{"map_error_m", 0.1}};
  const auto value = [&](const Limit& limit) { return metric(report, limit.metric); };
  const bool is_known = std::ranges::any_of(limits, [&](const Limit& l) { return std::isfinite(value(l)); });
  const bool is_wrong = std::ranges::any_of(limits, [&](const Limit& l) { return value(l) > l.most_m; });
  report.metrics.emplace_back("changes", static_cast<double>(changes));
  if (!is_known) return;
  report.metrics.emplace_back("wrong", is_wrong ? 1.0 : 0.0);
  report.metrics.emplace_back("false_done", is_wrong && report.status == "done" ? 1.0 : 0.0);
}

}  // namespace outrider
