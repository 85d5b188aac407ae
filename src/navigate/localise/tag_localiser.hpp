// The row `tags` of robot_localisers().
#pragma once

#include <memory>

#include "outrider/navigate/robot_localiser.hpp"

namespace outrider {

/// Faults: bad_input without tags, for tags that are not valid, and for a start that is not finite.
Outcome<std::unique_ptr<RobotLocaliser>> make_tag_localiser(LocaliserStart start);

}  // namespace outrider
