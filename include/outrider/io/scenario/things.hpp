// Things that stand in a world and are on no map, as scenarios say it.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// Adds boxes "x,y,length,width" and posts "x,y,radius", in m, separated by blanks, to a world; they are at
/// least 1 m high, and as high as the robot. Fault: bad_input at the key "things".
Status add_things(const std::string& text, double robot_height_m, World& world);

}  // namespace outrider
