// A picture of paths on a grid.
#pragma once

#include <string>
#include <vector>

#include "outrider/path/plan.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::cli {

struct DrawnPath {
  std::string name;
  Plan plan;
};

/// SVG: obstacles dark, what the robot's radius adds to them lighter, each path in a colour of its own with
/// its name and length. `occupied` may be empty; both grids have one frame.
std::string path_picture(const Grid<std::uint8_t>& occupied, const Grid<std::uint8_t>& blocked,
                         const std::vector<DrawnPath>& paths);

}  // namespace outrider::cli
