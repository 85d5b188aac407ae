// A question to a planner of robots that steer, in the unit of its search: cells.
#pragma once

#include <optional>
#include <vector>

#include "outrider/path/steering/steering_options.hpp"

namespace outrider {

/// The question in cells: the grid has its lowest corner at the origin and cells of side 1.
struct SteeringQuery {
  const GridMap* ground = nullptr;
  Vec2 start;
  Vec2 goal;
  std::optional<double> start_heading_rad;
  std::optional<double> goal_heading_rad;
  double radius = 0.0;        ///< turning radius
  bool reverse = false;       ///< the robot can drive backwards
  double cusp = 0.0;          ///< price of a cusp
  double backward = 1.0;      ///< price of a cell backwards
  std::vector<double> disks;  ///< centres of the disks, ahead of the planned point

  [[nodiscard]] double price_of(double length) const { return length < 0.0 ? -backward * length : length; }
};

/// Converts the question after checking it. Faults: those of grid_query(); bad_input for a grid of corners,
/// headings that are not finite, and options out of range; start_blocked and goal_blocked where a disk
/// touches a blocked cell, for an end with a heading.
Outcome<SteeringQuery> steering_query(const Problem& problem, const SteeringOptions& options,
                                      std::string_view planner);

/// Returns true if no disk of the robot touches a blocked cell anywhere along a piece that begins with that
/// heading. In cells.
bool clear_of_cells(const SteeringQuery& query, const PathPiece& piece, double heading_rad);

}  // namespace outrider
