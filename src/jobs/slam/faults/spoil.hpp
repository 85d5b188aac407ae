// Spoils a recording by its RecordingFaults.
//
// Same recording, faults and random stream: same result. Each kind of fault draws from a child stream of its
// own. O(recording). Expects faults that check() accepts for the kind of recording.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/io/log/carmen_log.hpp"
#include "outrider/jobs/slam/faults/recording_faults.hpp"
#include "outrider/slam/graph/pose_graph.hpp"
#include "outrider/slam/landmark/landmark_log.hpp"

namespace outrider {

/// A recording after the faults.
template <class Recording>
struct Spoiled {
  Recording recording;
  std::size_t changes = 0;  ///< how often a scan, sighting, motion or edge was changed or lost
};

/// Scans that are lost add their motion to the next one; a part that is cut out adds none. The reference
/// keeps the poses of the steps that are left. Fault: bad_input if no scan is left.
Outcome<Spoiled<LaserLog>> spoiled(const LaserLog& log, const RecordingFaults& faults, const Rng& rng);

/// Steps stay, with fewer sightings; only a part that is cut out has none. Faults: bad_input if no step is
/// left, and for wrong ids of fewer than two landmarks.
Outcome<Spoiled<LandmarkLog>> spoiled(const LandmarkLog& log, const RecordingFaults& faults, const Rng& rng);

/// Odometry is the edges between poses that follow each other. An outlier among the other edges between poses
/// ends at another pose; one among those to points and ranges measures anything up to the farthest. Faults:
/// bad_input if the graph has no edge that a fault could change.
template <class Pose>
Outcome<Spoiled<PoseGraphOf<Pose>>> spoiled(const PoseGraphOf<Pose>& graph, const RecordingFaults& faults,
                                            const Rng& rng);

}  // namespace outrider
