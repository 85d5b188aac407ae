#include "outrider/jobs/slam/scenario.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "outrider/io/text.hpp"

namespace outrider {

LaserSlamOptions laser_options_for_logs() {
  LaserSlamOptions options;
  options.draw_late = true;
  options.odometry_distance = 0.1;
  options.odometry_turn = 0.1;
  options.odometry_turn_per_distance_rad = 0.1;
  options.odometry_rest_m = 0.05;
  options.odometry_rest_rad = 0.03;
  return options;
}

std::vector<OptionGroup> describe(SlamScenario& scenario) {
  std::vector<Option> graph = describe(scenario.graph);
  graph.push_back({"measured_frame", "", 0, 0,
                   "errors of poses in the frame of the measured pose, as g2o has them",
                   &scenario.measured_frame});
  return {
      {"",
       "what was recorded",
       {{"job", "", 0, 0, "what is asked for; slam", &scenario.job},
        {"log", "", 0, 0, "laser log, landmark log, g2o graph or PyFG graph (.gz may follow)", &scenario.log},
        {"truth", "", 0, 0, "file with the true landmarks of a Freiburg log", &scenario.truth}}},
      {"slam", "landmarks", describe(scenario.landmarks)},
      {"noise", "noise of logs that give none", describe(scenario.noise)},
      {"carmen", "laser logs", describe(scenario.carmen)},
      {"laser", "laser scans", describe(scenario.laser)},
      {"map", "map of laser scans", describe(scenario.laser.map)},
      {"graph", "graphs", std::move(graph)}};
}

void resolve_paths(SlamScenario& scenario, const std::string& scenario_path) {
  const auto folder = std::filesystem::path(scenario_path).parent_path();
  for (std::string* path : {&scenario.log, &scenario.truth}) {
    if (!path->empty()) *path = (folder / *path).lexically_normal().string();
  }
}

Status check(const SlamScenario& scenario) {
  if (scenario.job != "slam") {
    return bad_input(
        fmt::format("'{}' is not a job of this scenario; the job is slam", excerpt(scenario.job)), "job");
  }
  if (scenario.log.empty()) return bad_input("it is missing; name the file of a log or a graph", "log");
  return {};
}

}  // namespace outrider
