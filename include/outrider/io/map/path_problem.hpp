// Loads path problems from map files.
//
// Takes every map of io/map/map.hpp. A polygon environment becomes polygons; any other map becomes a grid
// that is free for the disk. Start and goal are in the coordinates of the map, m (MovingAI: cells, y from the
// bottom). The planner checks that they are free. Faults: bad_input with file and line; also for a map_server
// map with a rotation, because its grid has axes of its own: use load_map_server() for such a map.
#pragma once

#include <optional>
#include <string>

#include "outrider/path/problem.hpp"

namespace outrider {

struct MapOptions {
  std::optional<double> radius_m;  ///< of the robot; unset: MovingAI 0, polygons 0.18, others 0.26
  double height_m = 0.2;           ///< height of the robot, for worlds
  double resolution_m = 0.1;       ///< resolution of the grid, for worlds
  GridModel model = GridModel::cells;
};

Outcome<Problem> load_path_problem(const std::string& path, Vec2 start, Vec2 goal,
                                   const MapOptions& options = {});

}  // namespace outrider
