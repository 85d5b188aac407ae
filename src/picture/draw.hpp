// The parts of a plan view, from below to above. Each draws the channels that the log has.
#pragma once

#include "outrider/log/log.hpp"
#include "sheet.hpp"

namespace outrider::picture {

/// Grids of cells: the map, costs, searches, firing regions.
void draw_cells(Sheet& sheet, const Log& log);
/// Areas, terrain, walls and solids.
void draw_ground(Sheet& sheet, const Log& log);
/// Paths, tracks, beliefs and the robot.
void draw_lines(Sheet& sheet, const Log& log);
/// Landmarks, tags, waypoints, goals, stations, shots and targets.
void draw_marks(Sheet& sheet, const Log& log);

}  // namespace outrider::picture
