// outrider plan on a polygon environment, or on the solids of an SDF world as polygons.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/path/catalog.hpp"

namespace outrider::cli {

struct PolygonPlan {
  std::string map;
  std::string from;             ///< with `to`, or `query`
  std::vector<std::string> to;  ///< one or more
  std::string query;            ///< all, or a number from 1
  std::string out;              ///< folder for plan.json and pictures; may be empty
  std::string svg;              ///< one picture; may be empty
  std::string planner;          ///< empty: the quickest on polygons
  bool compare = false;
  bool json = false;
  GridModel model = GridModel::corners;  ///< of the grid for planners that need one
  double radius_m = 0.18;
  double height_m = 0.2;               ///< of the robot, in a world of solids
  std::optional<double> resolution_m;  ///< of that grid [0.05]
  std::vector<std::pair<PathPlanner, ConfiguredPlanner>> planners;
};

/// Whether the name of the file is that of a polygon environment: .txt, .gz may follow.
bool is_polygon_map(const std::string& path);

/// Plans, has every plan judged by exact distances, writes and prints; the exit status. Among several
/// queries one that is refused has its reason in its row, and the others go on.
int plan_on_polygons(const PolygonPlan& request);

}  // namespace outrider::cli
