// A question to a planner of robots that steer, in the unit of its search: cells.
#pragma once

#include <optional>
#include <vector>

#include "outrider/path/steering/steering_options.hpp"
#include "steering/outline_room.hpp"

namespace outrider {

/// The question in cells: the grid has its lowest corner at the origin and cells of side 1.
struct SteeringQuery {
  const GridMap* ground = nullptr;
  Vec2 start;
  Vec2 goal;
  std::optional<double> start_heading_rad;
  std::optional<double> goal_heading_rad;
  double radius = 0.0;                ///< turning radius
  bool reverse = false;               ///< the robot can drive backwards
  double cusp = 0.0;                  ///< price of a cusp
  double backward = 1.0;              ///< price of a cell backwards
  std::vector<Vec2> outline;          ///< that of the problem; of a disk its origin
  const OutlineRoom* room = nullptr;  ///< in which it moves

  [[nodiscard]] double price_of(double length) const { return length < 0.0 ? -backward * length : length; }
};

/// Converts the question after checking it. Faults: those of grid_query(); bad_input for a grid of corners,
/// headings that are not finite, options out of range, and an outline that check_footprint() refuses;
/// start_blocked and goal_blocked where the robot touches a blocked cell, at an end without a heading in
/// every one; cancelled. Prepares `room`, which must outlive the question. O(cells) for a robot with an
/// outline.
Outcome<SteeringQuery> steering_query(const Problem& problem, const SteeringOptions& options,
                                      std::string_view planner, OutlineRoom& room,
                                      const std::stop_token& stop);

/// Returns true if the robot touches no blocked cell anywhere along a piece that begins with that heading. In
/// cells. Exact (outline_sweep.hpp).
bool clear_of_cells(const SteeringQuery& query, const PathPiece& piece, double heading_rad);

}  // namespace outrider
