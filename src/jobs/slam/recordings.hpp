// The mapping of each kind of recording.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input.hpp"
#include "outrider/io/log/laser_topics.hpp"
#include "outrider/job/job.hpp"
#include "outrider/jobs/slam/job.hpp"
#include "outrider/slam/map/map_localiser.hpp"

namespace outrider {

/// A log of ROS topics, which is read while it is mapped.
using TopicsInput = std::unique_ptr<LaserSource>;

/// Map a recording. Each reports the numbers that docs/jobs/slam.md lists.
template <class Pose>
Status solve_graph(const SlamJob& job, const GraphInput<Pose>& input, Run& run, const RunWatch& watch);
Status map_landmark_log(const SlamJob& job, LandmarkLog log, Run& run, const RunWatch& watch);
/// `recorded` is the log as it was before the faults, or empty.
Status map_laser_log(const SlamJob& job, const LaserLog& log, const LaserLog& recorded, Run& run,
                     const RunWatch& watch);
Status map_laser_topics(const SlamJob& job, TopicsInput source, Run& run, const RunWatch& watch);

/// Opens a log of ROS topics again if `source` is null, because an earlier run has read it.
Status open_again(TopicsInput& source, const SlamScenario& scenario);

/// Reads a map on which a robot can be localised. Faults: those of load_map(), and bad_input for a map
/// without unknown cells.
Outcome<KnownMap> load_known_map(const std::string& path);
/// Localise the robot of a laser log. Report what docs/jobs/slam.md lists.
Status localise_laser_log(const SlamJob& job, const LaserLog& log, const KnownMap& map, Run& run,
                          const RunWatch& watch);
Status localise_laser_topics(const SlamJob& job, TopicsInput source, const KnownMap& map, Run& run,
                             const RunWatch& watch);

using Metrics = std::vector<std::pair<std::string, double>>;

/// Returns the value, or NaN if there is none.
inline double known(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace outrider
