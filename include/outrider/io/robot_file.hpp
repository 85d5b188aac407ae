// Robots from their own files: URDF, or SDF with one model.
//
// Read are the collisions of all links, with the joints at zero, as sdf.hpp reads those of a world. The frame
// of the robot is that of its link base_footprint, or else base_link, or else of the model, on the floor: z
// is measured from the lowest point of its collisions.
//
// Faults: those of sdf.hpp; bad_input for a robot without collisions, or with a plane or a heightmap.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/io/sdf.hpp"

namespace outrider {

struct RobotFile {
  std::vector<Vec2> outline;  ///< convex, counter-clockwise; contains all collisions, seen from above
  double radius_m = 0.0;      ///< of the disk about the robot's origin that contains them
  double height_m = 0.0;
  std::map<std::string, Pose3, std::less<>> robot_T_frame;  ///< of its links and frames, by name
  std::vector<std::string> warnings;
};

Outcome<RobotFile> load_robot(const std::string& path, const SdfOptions& options = {});

/// Returns where a sensor stands. Fault: bad_input at `key` with the names that the robot has.
Outcome<Pose3> mount(const RobotFile& robot, const std::string& frame, const std::string& key);

}  // namespace outrider
