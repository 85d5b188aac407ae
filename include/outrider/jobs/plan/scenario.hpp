// PlanScenario: the settings of the job `plan`: a map, a start, one or several goals, planners and their
// options.
//
//   job: plan
//   map: room_map.txt        # map_server .yaml, SDF .sdf or .world, MovingAI .map, polygons .txt
//   from: "1,2"              # x,y in m (MovingAI: cells, y from the bottom)
//   to: "5,2 1,5"            # one goal or several; x,y,heading for planners of robots that steer
//   planner: theta_star
//   radius: 0.2              # of the robot, or room around its footprint
//
// The options of a planner are in the section of its name. Some defaults depend on the kind of map, see
// settle(). A published scenario should set these options explicitly.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/motion/fastest_drive.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/from_world.hpp"

namespace outrider {

/// A planner of the catalogue with its own set of options.
using ChosenPlanner = std::pair<PathPlanner, ConfiguredPlanner>;

/// The settings.
struct PlanScenario {
  PlanScenario();

  std::string map;    ///< path of a file
  SdfOptions sdf;     ///< where it finds models
  std::string from;   ///< x,y or x,y,heading
  std::string to;     ///< one or several goals, each as `from`, separated by blanks
  std::string query;  ///< number of a query in a polygon file, or "all"; replaces from and to
  std::string planner = "theta_star";  ///< a name of the catalogue
  bool compare = false;         ///< run every planner that accepts the map and steers as `planner` does
  std::string model = "cells";  ///< grid model: cells or corners
  double radius_m = 0.26;       ///< radius of the robot, or room around its footprint
  std::string footprint;        ///< corners (parse_footprint()); empty: a disk
  double height_m = 0.2;        ///< height of the robot, for SDF worlds
  GridOptions grid;             ///< options of a grid that is made from exact shapes
  bool trace = false;           ///< show what the search expands; grids only
  std::string block;            ///< cells to block: x,y or x,y,width,height, separated by blanks
  std::string index;            ///< file in which the planner keeps its index; empty: none
  std::string free;             ///< cells to free, in the same form; applied after `block`
  std::string costs;            ///< file of a cost map (io/map/cost_map.hpp); empty: a metre costs 1
  double cost_of_black = 10.0;  ///< cost per metre of a black pixel of that image
  std::string terrain;          ///< file of an ESRI ASCII grid of heights; empty: that of the world, if any
  double slope_cost = 0.0;      ///< cost per metre added for the tangent of the slope
  DriveLimits drive;            ///< of the robot on its path, for the time that it takes
  std::vector<ChosenPlanner> planners;  ///< all planners of the catalogue, with their options
};

/// Returns the options: top-level keys first, then the limits of the drive, then a section for each planner
/// that has options. They point into the scenario.
std::vector<OptionGroup> describe(PlanScenario& scenario);

/// Checks for missing keys and for keys that exclude each other, as far as possible without the map.
Status check(const PlanScenario& scenario);

/// Returns the grid model of that name. The fault names the key "model".
Outcome<GridModel> find_grid_model(const std::string& name);

/// Returns true if the scenario gives costs to the ground.
bool has_costs(const PlanScenario& scenario);

/// Checks that the planner accepts grids of that model, or the polygons of a map that has some. The fault
/// names the key "planner".
Status check_takes(const PathPlanner& planner, GridModel model, bool has_polygons);

/// Returns the scenario with the defaults for that kind of map, for all keys that are not `given`. On
/// MovingAI maps, and with a footprint, the radius is 0. On polygons the radius is 0.18 m, the planner is
/// visibility_graph_reduced, and planners that need a grid get one of model corners with a resolution of 0.05
/// m. Where the ground has costs, the planner is terrain_theta_star, and the model is cells.
PlanScenario settle(PlanScenario scenario, MapKind kind, const std::set<std::string>& given);

}  // namespace outrider
