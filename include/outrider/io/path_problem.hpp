// A question for the path planners from a map file: the short way from a file to a plan.
//
// Takes every map of io/map.hpp: a polygon environment becomes polygons, any other a grid that is free for
// the disk. Start and goal are in the coordinates of the map, m (MovingAI: cells, y from the bottom); whether
// they are free is asked by the planner. Faults: bad_input with file and line; on a map_server map that is
// turned, whose grid has axes of its own: load it with load_map_server().
#pragma once

#include <optional>
#include <string>

#include "outrider/path/problem.hpp"

namespace outrider {

struct MapOptions {
  std::optional<double> radius_m;  ///< of the robot; 0 on MovingAI maps, 0.18 on polygons, else 0.26
  double height_m = 0.2;           ///< of the robot, in worlds
  double resolution_m = 0.1;       ///< of the grid, in worlds
  GridModel model = GridModel::cells;
};

Outcome<Problem> load_path_problem(const std::string& path, Vec2 start, Vec2 goal,
                                   const MapOptions& options = {});

}  // namespace outrider
