// A picture of paths on a map.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/trace.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

struct DrawnPath {
  std::string name;
  Plan plan;
};

struct PathPicture {
  const Grid<std::uint8_t>& occupied;  ///< cells that hold something; may be empty
  const Grid<std::uint8_t>& blocked;   ///< cells where the robot's centre must not be
  std::vector<RoundedPolygon> obstacles;
  Vec2 start;
  std::vector<Vec2> goals;
  std::vector<DrawnPath> paths;
  std::shared_ptr<const GridMap> ground = nullptr;  ///< for the trace; none: no trace is drawn
  Trace trace = {};
};

/// SVG: obstacles dark, what the robot's radius adds to them lighter, start and goal, a length to scale,
/// each path in a colour of its own with its name and length. What the trace expanded is dotted, the first
/// lightest; on small grids each dot is joined to its parent and bears its turn, f and g + h in cells. Fit
/// for light and dark pages.
std::string to_svg(const PathPicture& picture);

}  // namespace outrider
