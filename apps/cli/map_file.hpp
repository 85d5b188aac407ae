// Any map that a path can be planned on, made ready for a disk robot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/world/ground.hpp"

namespace outrider::cli {

struct MapFile {
  Grid<std::uint8_t> occupied;   ///< cells that hold something; empty for a world of solids
  Grid<std::uint8_t> blocked;    ///< cells where the robot's centre must not be
  std::optional<Ground> ground;  ///< exact obstacles, where the file has them
  double yaw_rad = 0.0;          ///< of the grid about its origin, in the world
  double radius_m = 0.0;         ///< of the robot
  std::vector<std::string> warnings;

  [[nodiscard]] Vec2 to_grid(Vec2 world) const;
  [[nodiscard]] Vec2 to_world(Vec2 grid) const;
};

/// Whether the name of the file is that of an SDF world.
bool is_world(const std::string& path);

/// By the name of the file: .yaml and .yml map_server, .sdf and .world SDF, .map MovingAI; .gz after any.
/// Without a radius it is that of the robot, and 0 for MovingAI. The rest of the robot and `grid` matter
/// for SDF worlds only.
Outcome<MapFile> load_map(const std::string& path, std::optional<double> radius_m, const RobotModel& robot,
                          const GridOptions& grid);

}  // namespace outrider::cli
