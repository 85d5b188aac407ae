// The inputs of the job slam. The kind is detected from the contents of the file; files beside it complete
// the input.
#pragma once

#include <string>
#include <variant>

#include "outrider/io/carmen_log.hpp"
#include "outrider/io/pyfg.hpp"

namespace outrider {

struct GraphInput {
  PoseGraph graph;
  std::vector<Pose2> truth;  ///< by node; empty where unknown
};

using SlamInput = std::variant<GraphInput, LandmarkLog, LaserLog>;

/// Loads a file of one of these kinds: a g2o or PyFG graph; a Freiburg log, with the map `truth` or
/// "world.dat" beside it; an MR.CLAM log by its odometry file, with the measurements, barcodes and landmarks
/// beside it; a chain; a laser log of CARMEN.
Outcome<SlamInput> load_slam_input(const std::string& path, const std::string& truth, const LogNoise& noise,
                                   const CarmenOptions& carmen);

}  // namespace outrider
