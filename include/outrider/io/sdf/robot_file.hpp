// Robots from their own files: URDF, or SDF with one model.
//
// Read are the collisions of all links, with the joints at zero, as sdf.hpp reads those of a world. The frame
// of the robot is that of its link base_footprint, or else base_link, or else of the model, on the floor: z
// is measured from the lowest point of its collisions.
//
// Faults: those of sdf.hpp; bad_input for a robot without collisions, or with a plane or a heightmap.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/io/sdf/sdf.hpp"

namespace outrider {

struct RobotFile {
  std::vector<Vec2> outline;  ///< convex, counter-clockwise; contains all collisions, seen from above
  double radius_m = 0.0;      ///< radius of the disk about the robot's origin that contains them
  double height_m = 0.0;
  std::map<std::string, Pose3, std::less<>> robot_T_frame;  ///< pose of each link and frame, by name
  std::vector<std::string> warnings;
};

Outcome<RobotFile> load_robot(const std::string& path, const SdfOptions& options = {});

/// Returns where a sensor stands. Fault: bad_input at `key` with the names that the robot has.
Outcome<Pose3> mount(const RobotFile& robot, const std::string& frame, const std::string& key);

/// The own file of a robot, as a scenario names it.
struct RobotFileOptions {
  std::string file;  ///< empty: the options of the scenario say how large the robot is
  std::string link;  ///< the link or frame of its sensor; empty: the options say where it stands
};

/// Describes the file; the option of the link stands with those of the sensor.
Option describe_file(RobotFileOptions& options, std::string name);
Option describe_link(RobotFileOptions& options);

/// Takes the size of the robot from its file, if it has one, and adds the warnings. Returns the mount of its
/// sensor; nothing if no link is named. Faults: those of load_robot(), and bad_input at `link_key`.
Outcome<std::optional<Pose3>> take_robot_file(const RobotFileOptions& options, const std::string& link_key,
                                              const SdfOptions& sdf, double& radius_m, double& height_m,
                                              std::vector<std::string>& warnings);

}  // namespace outrider
