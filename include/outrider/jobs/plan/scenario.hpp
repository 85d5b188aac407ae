// The scenario of a path: a map, a start, one or several goals, planners and their options.
//
//   job: plan
//   map: room_map.txt        # map_server .yaml, SDF .sdf or .world, MovingAI .map, polygons .txt
//   from: "1,2"              # x,y in m (MovingAI: cells, y from the bottom)
//   to: "5,2 1,5"            # one goal or several
//   planner: theta_star
//   radius: 0.2              # of the robot
//
// The options of a planner stand in the section of its name. Some defaults depend on the map, settle() tells
// which; a scenario that is published sets everything it wants.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/map.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/from_world.hpp"

namespace outrider {

/// A row of the catalogue with options of its own.
using ChosenPlanner = std::pair<PathPlanner, ConfiguredPlanner>;

struct PlanScenario {
  PlanScenario();

  std::string map;                     ///< path of a file
  std::string from;                    ///< x,y
  std::string to;                      ///< x,y; several with blanks between
  std::string query;                   ///< of a polygon environment, instead of from and to: all, or a number
  std::string planner = "theta_star";  ///< of the catalogue
  bool compare = false;                ///< asks every planner that takes the map
  std::string model = "cells";         ///< or corners: the grid of a planner that takes no polygons
  double radius_m = 0.26;              ///< of the robot
  double height_m = 0.2;               ///< of the robot, for SDF worlds
  GridOptions grid;                    ///< that is made of a map with exact shapes
  bool trace = false;                  ///< shows what the search expands; on grids
  std::string block;                   ///< x,y or x,y,width,height of cells; several with blanks between
  std::string free;                    ///< the same; after all of `block`
  std::vector<ChosenPlanner> planners;  ///< the catalogue
};

/// Top-level keys first, then a section for each planner that has options. They point into the scenario.
std::vector<OptionGroup> describe(PlanScenario& scenario);

/// Refuses what is missing, and keys that exclude each other, as far as that can be told without the map.
Status check(const PlanScenario& scenario);

/// The grid of that name; the fault names the key "model".
Outcome<GridModel> find_grid_model(const std::string& name);

/// Refuses a planner that takes no such grid, nor the polygons of a map that has some; the fault names the
/// key "planner".
Status check_takes(const PathPlanner& planner, GridModel model, bool has_polygons);

/// The scenario with the defaults of that kind of map for all that is not `given`: a radius of 0 on MovingAI
/// maps and 0.18 m on polygons; on polygons the planner visibility_graph_reduced, and corners of 0.05 m for
/// planners that need a grid.
PlanScenario settle(PlanScenario scenario, MapKind kind, const std::set<std::string>& given);

}  // namespace outrider
