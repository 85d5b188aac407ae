// The inputs of the job slam. The kind is detected from the contents of the file; files beside it complete
// the input.
#pragma once

#include <string>
#include <variant>

#include "outrider/jobs/slam/scenario.hpp"

namespace outrider {

template <class Pose>
struct GraphInput {
  PoseGraphOf<Pose> graph;
  std::vector<Pose> truth;  ///< by node; empty where unknown
};

using SlamInput = std::variant<GraphInput<Pose2>, GraphInput<Pose3>, LandmarkLog, LaserLog>;

/// Loads the log, a file of one of these kinds: a g2o, TORO or PyFG graph; a Freiburg log, with the map
/// `truth` or "world.dat" beside it; an MR.CLAM log by its odometry file, with the measurements, barcodes and
/// landmarks beside it; a chain; a laser log of CARMEN.
Outcome<SlamInput> load_slam_input(const SlamScenario& scenario);

}  // namespace outrider
