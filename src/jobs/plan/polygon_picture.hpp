// A picture of paths among polygons.
#pragma once

#include <string>
#include <vector>

#include "outrider/path/plan.hpp"

namespace outrider {

struct DrawnWay {
  std::string name;
  Plan plan;
};

struct PolygonPicture {
  std::shared_ptr<const PolygonGround> ground;
  const Grid<std::uint8_t>* blocked = nullptr;  ///< of the grid that others planned on; may be none
  std::vector<Segment> legs;                    ///< of the visibility graph
  std::vector<DrawnWay> ways;
};

/// SVG: solid ground dark, what the robot's radius adds to it lighter, with its true arcs; the cells that a
/// grid blocks beyond that shaded; the legs of the visibility graph as hair lines; and each way in a colour
/// of its own, arcs as arcs, with its name and length below.
std::string polygon_picture(const PolygonPicture& picture);

}  // namespace outrider
