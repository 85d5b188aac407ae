// World changes as text: two keys of a scenario that move or remove objects of a world (world/changes.hpp).
//
//     moved: bench=1.5,-2,90; shed=0,4,0
//     removed: tree_1; tree_2
//
// A move gives x and y in m, the new position of the middle of the upright box around these solids in the
// original world, and the angle in degrees by which they are turned about it, counter-clockwise. Faults:
// bad_input with the key.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/changes.hpp"

namespace outrider {

/// Parses the two values above; each may be empty.
Outcome<WorldChanges> changes_from_text(std::string_view moved, std::string_view removed);
/// Returns an angle in degrees as text, without rounding errors of whole numbers: 90, not 90.00000000000001.
std::string degrees_text(double angle_rad);
std::string moved_text(const std::vector<MovedThing>& moved);
std::string removed_text(const std::vector<std::string>& removed);

}  // namespace outrider
