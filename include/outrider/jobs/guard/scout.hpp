// Scouting: guarding a yard that is not known. It is explored first, and the targets that come into sight on
// the way are kept in mind; then the map found and these targets are the yard that is guarded.
//
// What is assumed of what cannot be seen: whatever is not known to be free stands from the floor up to
// `wall_height_m`, so a shot goes around it or over that height; and the floor is level. A thing that the
// plane of the range finder misses, because it is lower or hangs above, is not on the map.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

struct ScoutOptions {
  bool unknown = false;         ///< the yard is: explore it first
  double sight_m = 8.0;         ///< a target farther away is not made out
  double sight_error_m = 0.05;  ///< of the place of a target by one look, standard deviation along x and y
  double wall_height_m = 3.0;   ///< to which what stands on the map is taken to rise
};
std::vector<Option> describe(ScoutOptions& options);

/// Where a target was seen, by all looks together.
struct SeenTarget {
  Vec2 mean;  ///< of the places seen
  std::int64_t looks = 0;
  double first_s = 0.0;
  double last_s = 0.0;

  void add(Vec2 place, double time_s);
};

/// The yard as it was found, for a robot that now stands at `start`.
struct FoundYard {
  GuardProblem problem;
  std::vector<std::size_t> targets;  ///< of the problem's: which of all targets each is
  std::vector<std::size_t> buried;   ///< seen, but where the map has something
};

/// The world is made of the cells of the map that are not free; where the robot `stood`, its disk has pushed
/// through, and they are free. Its bounds are those of what is free, with a wall of one cell around. The
/// robot is wider by a cell and the error of its arrivals, as far as the start leaves room. `known`: robot,
/// gun, gravity, floor and errors, and the sizes of the targets. Refused: a map without a free cell.
Outcome<FoundYard> found_yard(const GuardProblem& known, const ScoutOptions& options,
                              Grid<std::uint8_t> occupancy, const std::vector<Vec2>& stood,
                              const std::vector<std::optional<SeenTarget>>& seen, const Pose2& start);

}  // namespace outrider
