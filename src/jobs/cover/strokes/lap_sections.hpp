// Sections of laps: where lanes of a taper end far from each other, the way between their ends leads along a
// lap, which is to be driven anyway. So the lap is cut beside such ends, and beside those where cells are
// entered and left, and its sections are driven between the lanes.
#pragma once

#include <stop_token>

#include "ground/sweep_cells.hpp"
#include "strokes/laps.hpp"

namespace outrider::cover {

/// Returns the lap cut beside the ends of the outer lanes of each cell, and of neighbouring lanes whose ends
/// lie farther apart than `far_m`: where these are nearer to it than `near_m`, and no section is shorter than
/// that. The lap alone where none are. Fewer cuts after a stop request. O(pieces x lanes).
std::vector<Lap> lap_sections(const Lap& lap, const std::vector<SweepCell>& cells, double far_m,
                              double near_m, const std::stop_token& stop = {});

}  // namespace outrider::cover
