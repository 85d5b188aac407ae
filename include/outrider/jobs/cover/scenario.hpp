// The scenario of covering an area: every setting under the name it has in files and flags.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/jobs/cover/ground/saved_map.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/sim/navigation.hpp"

namespace outrider {

/// The settings of the job.
struct CoverScenario {
  std::string area;            ///< path of an area (io/map/cover_area.hpp) or a saved map (saved_map.hpp)
  std::string units = "auto";  ///< units of the area: auto, degrees or metres
  std::string method = "quickest";  ///< name of a row of cover_methods()
  std::string start;  ///< "x,y,heading" in the coordinates of the area; empty: where the track begins
  double map_tolerance_m = 0.0;  ///< see SavedMapOptions
  double error_factor = 1.0;     ///< see cover/bounds/time_bound.hpp
  std::int64_t seed = 1;         ///< of the simulated drive
  CoverProblem problem;          ///< its numbers are options; its polygons come from the file
  CoverOptions options;          ///< of the planner
  std::string sim = "ideal";     ///< ideal: the track as it is; navigator: around what stands there
  std::string things;            ///< that stand there and are on no map (add_things())
  NavigationOptions navigation = default_navigation();  ///< of a drive with the navigator

  /// Returns the options of a robot that knows where it is, and forgets nothing that it has seen.
  static NavigationOptions default_navigation();
};

/// Describes the options: the top-level keys, then the sections tool, pace, order and faults.
std::vector<OptionGroup> describe(CoverScenario& scenario);

/// Everything that a run needs.
struct CoverTask {
  CoverProblem problem;
  CoverMethod method;
  std::string note;  ///< how the units of the file were interpreted, if that is uncertain

  /// The rings as faults of cover_ground() name them, each with its place in the file.
  std::vector<std::pair<std::string, std::string>> places = {};
};

/// Reads the area and the names. Faults: bad_input with the file and line, or the key.
Outcome<CoverTask> load_task(const CoverScenario& scenario);

/// Returns the task of covering that area; `start` is in its coordinates.
CoverTask task_of(const CoverScenario& scenario, const CoverMethod& method, CoverArea area,
                  const std::optional<Pose2>& start);

/// Returns how a map becomes the area of the scenario.
SavedMapOptions map_options(const CoverScenario& scenario, const std::optional<Pose2>& start);

/// Replaces the place "boundary" or "hole 2 of area 2" of a fault by the place in the file.
Fault placed(Fault fault, const CoverTask& task);

}  // namespace outrider
