// The verification of plans of robots that steer. It shares no test of cells and no motions with the
// planners.
#pragma once

#include "outrider/path/plan.hpp"

namespace outrider {

/// Verifies on a grid that the pieces join in position and heading, from the pose at the start to that at the
/// goal; that no arc is tighter than the turning radius and none is driven backwards by a robot that cannot;
/// that every disk keeps off every blocked cell near each piece (exact distance between arc or leg and the
/// sides of the cell); and that the legs between waypoints stay within their stated error. O(cells in the
/// boxes of the pieces).
Status check_steering(const Plan& plan, const Problem& problem);

}  // namespace outrider
