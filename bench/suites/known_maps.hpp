// Known maps on which a navigator drives, and drives on them with what the maps lack, drawn from their
// numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/footprint.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/world.hpp"

namespace outrider::bench {

struct BenchMap {
  std::string name;
  Grid<std::uint8_t> occupancy;  ///< values of Occupancy
};

/// Loads map files, and the maps under a folder if it is not empty: those of map_server, and the published
/// grids as in explore_maps.hpp. What is reached from the edge of a map lies outside of the building and
/// counts as not known, unless nothing else is free. Faults: those of load_map(); a map of another kind.
Outcome<std::vector<BenchMap>> known_maps(const std::vector<std::string>& files, const std::string& folder);

/// A drive on a map: what stands there in truth, and whether there is a way.
struct MapCase {
  World world;
  Pose2 start;
  Vec2 goal;
  double way_m = 0.0;          ///< length of a short way on the map, without what it lacks
  std::int64_t people = 0;     ///< number of people who walk there
  bool start_unknown = false;  ///< the robot is not told where it starts
  bool closed = false;         ///< a narrow place on that way is closed
  bool surely_a_way = false;   ///< there is a way with room to spare
  bool surely_none = false;    ///< there is none, even for a point
};

/// Draws one; nothing if the map has no two places to drive between.
std::optional<MapCase> draw_case(const BenchMap& map, const Footprint& footprint, std::uint64_t number);

}  // namespace outrider::bench
