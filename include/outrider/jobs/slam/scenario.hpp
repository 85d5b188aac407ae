// The scenario of mapping from a recorded log: every setting under the name it has in files and flags.
//
//   job: slam
//   log: hall.log.gz           # laser log, landmark log, g2o or PyFG graph
//   laser: {reach: 20}
//
// The other keys stand in describe().
#pragma once

#include <string>
#include <vector>

#include "outrider/io/carmen_log.hpp"
#include "outrider/io/landmark_logs.hpp"
#include "outrider/slam/landmark_slam.hpp"
#include "outrider/slam/laser_slam.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

/// For recorded logs: odometry that is worse than a wheel's, and a map that is drawn once.
LaserSlamOptions laser_options_for_logs();

struct SlamScenario {
  std::string log;     ///< path of a file
  std::string truth;   ///< path of the true landmarks of a Freiburg log; empty: world.dat beside it, if any
  std::string resume;  ///< path of the state of an earlier run to continue from; landmark logs only
  bool measured_frame = false;  ///< errors of graph poses in the frame of the measured pose, as g2o has them
  LandmarkSlamOptions landmarks;
  LogNoise noise;
  PoseGraphOptions graph;
  CarmenOptions carmen;
  LaserSlamOptions laser = laser_options_for_logs();
};

/// The top-level keys first, then the sections. They point into the scenario.
std::vector<OptionGroup> describe(SlamScenario& scenario);

/// Refuses another job, and a log that is missing.
Status check(const SlamScenario& scenario);

}  // namespace outrider
