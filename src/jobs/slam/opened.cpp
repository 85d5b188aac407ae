#include "opened.hpp"

#include <filesystem>
#include <limits>

#include "outrider/report/slam_record.hpp"

namespace outrider {

double known(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

Report opened(const SlamScenario& scenario) {
  Report report;
  report.job = "slam";
  report.status = "done";
  const std::string name = std::filesystem::path(scenario.log).filename().string();
  report.world_name = name.substr(0, name.find('.'));
  report.robot_radius_m = std::numeric_limits<double>::quiet_NaN();
  return report;
}

void conclude(Report& report, Metrics metrics) {
  report.metrics.insert(report.metrics.begin(), metrics.begin(), metrics.end());
  report.bounds = bounds_of(report);
}

}  // namespace outrider
