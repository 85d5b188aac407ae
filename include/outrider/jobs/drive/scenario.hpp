// The scenario of a drive: a robot on wheels that goes to waypoints, or along a planner's path to a goal.
//
//   job: drive
//   waypoints: "0,0,0 1,0,0 1,2,180 0,0,0"   # x,y,heading in m and degrees; a ! behind one: pass by
//   tags: "1=2,1,180 2=1,2.5,-90 3=0,2,0"    # id=x,y,facing[,height]; facing: the heading out of the wall
// or, in place of waypoints,
//   world: arena.sdf
//   start: "0.5,0.5,45"
//   goal: "2.5,2.5,45"
//   planner: visibility_graph               # a path planner of 'outrider list'
//
// With `loop: laser` the navigator drives there by a range finder, around what stands in the way:
//
//   job: drive
//   loop: laser
//   map: office.yaml                        # the map that the robot has, or none
//   things: "3,2,0.5,0.4 5,1,0.2"           # boxes x,y,length,width and posts x,y,radius that no map has
//   goal: "6.5,4.6,90"                      # or waypoints
//   zones: {areas: "keep_out 1,1 2,1 2,2"}  # and slow ones, GeoJSON, filter masks of Nav2 (zone_file.hpp)
//
// Without a world the map is the world as well.
//
// describe() has the other keys: the robot, its loop (closed, open or laser), the source of images (rendered
// or modelled), and the sections follow, pid, reckoning, localise, camera, rules, route, laser, wheels,
// walk_ins, navigator, live_map, motion, zones, faults and link. The sections faults and link hold what the
// robot does not know.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/map/zone_file.hpp"
#include "outrider/io/sdf/robot_file.hpp"
#include "outrider/jobs/drive/mission/laser_drive.hpp"
#include "outrider/jobs/drive/route.hpp"
#include "outrider/jobs/drive/task.hpp"
#include "outrider/sim/faults/drive_sim_params.hpp"

namespace outrider {

/// The settings of the job.
struct DriveScenario {
  std::string world;            ///< path of a world; empty: the map, or open ground around waypoints and tags
  std::string map;              ///< path of the map of cells that a robot with a laser has; empty: none
  std::string things;           ///< as above
  SdfOptions sdf;               ///< where it finds models
  std::string bounds;           ///< low x, low y, high x, high y in m; empty: the box of the walls
  std::string start = "0,0,0";  ///< x, y in m, heading in degrees
  std::string waypoints;        ///< as above
  std::string goal;             ///< as the start
  std::string planner;          ///< a name of the catalogue of path planners
  std::string tags;             ///< as above
  std::string map_tags;         ///< where the robot believes the tags; empty: as `tags`
  double tag_size_m = default_tag_size_m;  ///< side of a tag
  std::string tag_family = "tag36h11";     ///< of all tags
  std::string loop = "closed";             ///< or open, or laser
  std::string sight = "rendered";          ///< or modelled
  std::string chassis = "mecanum";         ///< or differential, holonomic
  double wheel_radius_m = 0.03;            ///< of each wheel
  double wheel_reach_m = 0.1225;           ///< see chassis.hpp
  double radius_m = 0.15;                  ///< of the robot's disk
  double height_m = 0.25;                  ///< of the robot
  RobotFileOptions robot_file;             ///< its link is that of the camera
  std::string calibration;                 ///< path of a calibration file; empty: none
  std::int64_t seed = 1;                   ///< of the simulation
  DriveRouteOptions route;                 ///< of planned paths
  DriveSimParams sim;                      ///< errors of the simulated robot
  LaserDriveOptions laser;                 ///< options of a drive by laser
  ZoneSources zones;                       ///< zones of a drive by laser
  DriveTask task;                          ///< the other settings
};

/// Describes the options: the top-level keys, then the sections.
std::vector<OptionGroup> describe(DriveScenario& scenario);

/// Everything that a run needs.
struct DriveSetup {
  DriveTask task;
  DriveSimParams sim;
  bool rendered = true;               ///< images are rendered; false: modelled
  std::optional<Plan> plan;           ///< answer of the planner, if one was used
  double path_clearance_m = 0.0;      ///< least distance of its legs to an obstacle or the edge
  std::vector<std::string> warnings;  ///< what was repaired, and what tags will miss
};

/// Reads the files and the texts. Faults: bad_input with the file and line, or the key; start_blocked,
/// goal_blocked, no_path and the like from the planner.
Outcome<DriveSetup> load_drive(const DriveScenario& scenario);

/// The same for what commands wheels itself (DriveMission). Faults: bad_input besides, for a drive by laser.
Outcome<DriveSetup> load_wheel_drive(const DriveScenario& scenario);

}  // namespace outrider
