// Compares a map that was made of a spoiled recording with what is true.
#pragma once

#include "outrider/io/log/carmen_log.hpp"
#include "outrider/report/report.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns the mean distance of the occupied cells from the nearest beam end of a recording whose poses are
/// known, at most 1 m each; NaN if there are none. `map_T_reference` lays these poses over the map.
/// O(beams + occupied cells).
double wall_error_m(const Grid<std::uint8_t>& occupancy, const LaserLog& recorded,
                    const Pose2& map_T_reference, const Pose2& robot_T_laser);

/// Adds the metric `changes`, how often the recording was changed, and where a truth is known `wrong`: 1 if
/// the path is off by more than 0.25 m, or landmarks or walls by more than 0.1 m; and `false_done`: 1 if it
/// is wrong and the status is done.
void judge_by_truth(Report& report, std::size_t changes);

}  // namespace outrider
