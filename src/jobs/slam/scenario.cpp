#include "outrider/jobs/slam/scenario.hpp"

#include <fmt/format.h>

#include "outrider/io/files/text.hpp"

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
  graph.push_back({"information", "", 0, 0,
                   "which terms of information matrices count: all, diagonal or isotropic",
                   &scenario.information});
  std::vector<Option> top = {
      file_option("log", "ROS bag or MCAP, laser log, landmark log, g2o, TORO or PyFG graph (.gz may follow)",
                  &scenario.log),
      file_option("map",
                  "known map, on which the robot of a laser log is localised; without it, a map is made",
                  &scenario.map),
      file_option("truth", "file with the true landmarks of a Freiburg log", &scenario.truth),
      file_option("resume", "state of an earlier run to continue from", &scenario.resume),
      {"seed", "", 0, 1e15, "seed of the random numbers of the faults", &scenario.seed}};
  for (Option& option : describe(scenario.topics)) top.push_back(std::move(option));
  return {{"", "what was recorded", std::move(top)},
          {"slam", "landmarks", describe(scenario.landmarks)},
          {"faults", "what spoils the recording without the mapping being told", describe(scenario.faults)},
          {"noise", "noise of logs that give none", describe(scenario.noise)},
          {"carmen", "laser logs", describe(scenario.carmen)},
          {"laser", "laser scans", describe(scenario.laser)},
          {"occupancy", "map of laser scans", describe(scenario.laser.map)},
          {"graph", "graphs", std::move(graph)}};
}

Status check(const SlamScenario& scenario) {
  if (scenario.log.empty()) return bad_input("it is missing; name the file of a log or a graph", "log");
  if (scenario.information != "all" && scenario.information != "diagonal" &&
      scenario.information != "isotropic") {
    return bad_input(
        fmt::format("'{}' is not valid; expected all, diagonal, isotropic", excerpt(scenario.information)),
        "graph.information");
  }
  return {};
}

}  // namespace outrider
