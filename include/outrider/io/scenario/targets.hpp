// Target lists: the positions of the intruders in a yard.
//
// Each line is one target, with words key=value in any order; '#' starts a comment; blank lines are skipped:
//     type=1 x=-6.5 y=6.5 z=1.5 rz=3.1416      # a type has a size and a name
//     size=0.4,0.3,0.2 name=fox x=2 y=1        # or give them
// x, y, z (default: on the ground of the world) are the centre of the base in m; rz (default 0) is the
// heading in rad. Sizes by type, length x width x height in m: 1 0.5 x 0.205 x 0.372; 2 0.46 x 0.36 x 0.178;
// 3 0.51 x 0.1372 x 0.526; 4 0.2576 x 0.164 x 0.3712. An explicit size overrides that of the type.
// The k-th target of type T is named "T_k", counted from 0; without a type, "target_k".
//
// Faults: bad_input with file:line, the word and the remedy, for the first wrong line.
// Bounds: 100,000 targets, coordinates within 1e6 m, sizes in (0, 1e3] m. O(length of the file).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/ballistics/target.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// Loads a list. A target without a z stands on the ground of the world under its centre.
Outcome<std::vector<Target>> load_targets(const std::string& path, const World& world = {});

/// Reads a list from text. `name` is the name of the file in faults.
Outcome<std::vector<Target>> targets_from_text(std::string_view text, const std::string& name,
                                               const World& world = {});

/// Returns a list that reads back to exactly these targets, each with its name, size and height.
std::string targets_text(const std::vector<Target>& targets);

}  // namespace outrider
