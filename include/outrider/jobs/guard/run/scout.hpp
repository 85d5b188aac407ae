// Scouting: guarding an unknown yard. The robot first explores the yard and remembers the targets that it
// sees. The guard problem is then made from the map and these targets.
//
// Assumptions: every cell that is not known to be free is solid from the floor up to `wall_height_m`, so
// shots go around it or above that height; and the floor is level. An obstacle that lies below or above the
// plane of the range finder is not on the map.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

/// Options of scouting.
struct ScoutOptions {
  bool unknown = false;         ///< the yard is unknown: explore it first
  double sight_m = 8.0;         ///< largest distance at which a target is detected
  double sight_error_m = 0.05;  ///< standard deviation of an observed position, along x and y
  double wall_height_m = 3.0;   ///< assumed height of the obstacles on the map
};
std::vector<Option> describe(ScoutOptions& options);

/// The estimated position of a target from all its observations.
struct SeenTarget {
  Vec2 mean;               ///< mean of the observed positions
  std::int64_t looks = 0;  ///< number of observations
  double first_s = 0.0;    ///< time of the first observation
  double last_s = 0.0;     ///< time of the last observation

  /// Adds an observation.
  void add(Vec2 place, double time_s);
};

/// The guard problem of an explored yard.
struct FoundYard {
  GuardProblem problem;
  std::vector<std::size_t> targets;  ///< for each target of the problem: its index among all targets
};

/// Makes the guard problem of an explored yard. Each cell of the map that is not free becomes an obstacle,
/// except cells that the disk of the robot covered at the poses `stood`: these are free. Where the robot
/// touched something there is an obstacle, which its laser may not see. The bounds are those
/// of the free cells, with a wall of one cell around. The radius of the robot grows by one cell and the
/// position error of its arrivals, as far as the obstacles near `start` permit. `known` provides robot, gun,
/// gravity, floor, errors and the sizes of the targets. Fault: a map without a free cell.
Outcome<FoundYard> found_yard(const GuardProblem& known, const ScoutOptions& options,
                              Grid<std::uint8_t> occupancy, const std::vector<Vec2>& stood,
                              const std::vector<std::optional<SeenTarget>>& seen, const Pose2& start,
                              const std::vector<Vec2>& touched = {});

}  // namespace outrider
