// The scenario of mapping from a recorded log: every setting under the name it has in files and flags.
//
//   job: slam
//   log: hall.log.gz           # laser log, landmark log, g2o, TORO or PyFG graph
//   laser: {reach: 20}
//
// describe() has the other keys.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/io/log/carmen_log.hpp"
#include "outrider/io/log/landmark_logs.hpp"
#include "outrider/io/log/laser_topics.hpp"
#include "outrider/jobs/slam/faults/recording_faults.hpp"
#include "outrider/slam/graph/pose_graph.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

/// Returns options for recorded logs: odometry less accurate than wheel encoders, and a map that is drawn
/// once.
LaserSlamOptions laser_options_for_logs();

/// The settings of the job.
struct SlamScenario {
  std::string log;     ///< path of a file, or of the folder of a log
  std::string map;     ///< path of a known map to be localised on; empty: map the log
  std::string truth;   ///< path of the true landmarks of a Freiburg log; empty: world.dat beside it, if any
  std::string resume;  ///< path of the state of an earlier run to continue from; landmark logs only
  bool measured_frame = false;  ///< errors of graph poses in the frame of the measured pose, as g2o has them
  std::string information = "all";  ///< terms of the information matrices of graphs: InformationTerms
  LandmarkSlamOptions landmarks;    ///< of landmark logs
  LogNoise noise;                   ///< noise of landmark logs
  PoseGraphOptions graph;           ///< of pose graphs
  CarmenOptions carmen;             ///< of reading laser logs
  LaserTopicsOptions topics;        ///< of reading logs of ROS topics
  LaserSlamOptions laser = laser_options_for_logs();  ///< of laser logs
  RecordingFaults faults;                             ///< what spoils the recording before it is mapped
  std::int64_t seed = 1;                              ///< of the random numbers of the faults
};

/// Describes the options: the top-level keys, then the sections. They point into the scenario.
std::vector<OptionGroup> describe(SlamScenario& scenario);

/// Refuses a scenario without a log or of another job.
Status check(const SlamScenario& scenario);

}  // namespace outrider
