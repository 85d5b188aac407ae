// Checks the place at which a post is put in the way of a simulated robot.
#pragma once

#include "outrider/core/outcome.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// Refuses a place for a post that the key `faults.blocked_place` tells: outside the bounds of the world,
/// within what stands there, or without a time at which it is put there. Fault: bad_input with that key.
Status check_post_place(const World& world, Vec2 place, double blocked_at_s);

}  // namespace outrider
