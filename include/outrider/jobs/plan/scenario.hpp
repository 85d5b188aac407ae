// The scenario of a path: a map, a start, a goal, a planner and its options.
//
//   job: plan
//   map: room_map.txt        # map_server .yaml, SDF .sdf or .world, MovingAI .map, polygons .txt
//   from: "1,2"              # x,y in m (MovingAI: cells, y from the bottom)
//   to: "5,2"
//   planner: theta_star
//   radius: 0.2              # of the robot, on every kind of map
//
// The options of a planner stand in the section of its name. `outrider run` answers it, and the page writes
// it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/from_world.hpp"

namespace outrider {

struct PlanScenario {
  PlanScenario();

  std::string job = "plan";
  std::string map;   ///< path of a file
  std::string from;  ///< x,y
  std::string to;    ///< x,y
  std::string planner = "theta_star";
  std::string model = "cells";  ///< or corners: the grid of a planner that takes no polygons
  double radius_m = 0.18;       ///< of the robot
  double height_m = 0.2;        ///< of the robot, for SDF worlds
  GridOptions grid;             ///< that is made of a map with exact shapes
  std::vector<std::pair<PathPlanner, ConfiguredPlanner>>
      planners;  ///< the catalogue, with options of its own
};

/// Top-level keys first, then a section for each planner that has options. They point into the scenario.
std::vector<OptionGroup> describe(PlanScenario& scenario);

/// Makes the path of the map, which is relative to the scenario's file, relative to here.
void resolve_paths(PlanScenario& scenario, const std::string& scenario_path);

/// Refuses another job, and what is missing.
Status check(const PlanScenario& scenario);

}  // namespace outrider
