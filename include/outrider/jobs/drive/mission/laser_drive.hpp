// A drive by laser: the navigator (navigate/navigator.hpp) takes a robot with a range finder from waypoint to
// waypoint, around what stands there and who walks there. The robot has a map, or none, or one that lacks
// things.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/drive/task.hpp"
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"
#include "outrider/sim/navigation.hpp"

namespace outrider {

/// Options of a drive by laser.
struct LaserDriveOptions : NavigationOptions {
  std::string footprint;             ///< corners or radius (parse_footprint()); empty: the disk of the robot
  double turning_radius_m = 0.0;     ///< least radius of a curve, as of a car; 0: it turns in place
  double within_m = 0.15;            ///< distance from a waypoint at which the robot has arrived
  double within_rad = radians(5.0);  ///< the same of the heading at a stop
  bool start_unknown = false;        ///< the robot is not told where on its map it starts
  ZoneOptions keep;
  bool rendered = true;             ///< images of tags are rendered; false: modelled
  std::optional<TagMap> hung = {};  ///< where tags truly hang; nothing: where the task has them
};
/// Describes the options, by section of a scenario.
std::vector<OptionGroup> describe(LaserDriveOptions& options);
/// Returns the footprint, of a task that has a robot of that radius. Faults: those of parse_footprint().
Outcome<Footprint> footprint_of(const LaserDriveOptions& options, double radius_m);

/// Drives the task, of which it uses world, start, known map, zones, waypoints, radius and the limits of
/// `follow`, and with the localiser `tags` the tags and the camera, with a simulated robot on two wheels, and
/// logs the drive. The status is "done" if the robot arrived at every waypoint, was truly there within twice
/// the tolerance, touched nothing, and entered no keep-out zone. A pure function of its arguments, but for
/// the watch. Faults: those of parse_footprint() and Navigator::make(). Metrics:
///   driven_m, ideal_m, turned_rad, ideal_rad   of the true robot; along straight legs through the waypoints
///   time_s, contacts        that its own motion made
///   walked_into             people who walked into the robot, while its motion brought it no nearer
///   recoveries              most ways out of a place where nothing went on, in a row
///   located_m               way driven until the robot knew where it is; -1 if it never did
///   belief_error_m          largest error of the position that it believed to know
///   false_arrivals          waypoints called reached where the robot was not
///   kept_out                times that the footprint truly entered a keep-out zone
///   over_slow_s             time for which it truly was in a slow zone and faster than allowed there
/// and the table "waypoints" as run_drive() has it.
Outcome<Report> run_laser_drive(const DriveTask& task, double height_m, const LaserDriveOptions& options,
                                std::uint64_t seed, Log& log, const RunWatch& watch = {});

}  // namespace outrider
