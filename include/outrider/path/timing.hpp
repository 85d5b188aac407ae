// Timing: the fastest drive along a plan, whatever planner it is of.
//
// A plan is its pieces, or the legs between its waypoints if it has none. Where its direction changes by more
// than a microradian, a robot that turns in place comes to rest and turns by that angle; it stays in motion
// from a leg to an arc that touches it. A robot that steers (Plan::steering) never turns in place: it comes
// to rest at the cusps only, where it changes between driving forwards and backwards. The drive begins with
// the heading of the path, so no turn comes before its beginning or after its end.
#pragma once

#include <vector>

#include "outrider/motion/fastest_drive.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// Returns the pieces of the plan with its corners or cusps. Pieces of less than a nanometre are left out: an
/// arc of radius 0 is a corner. O(pieces).
std::vector<CurvePiece> curve_of(const Plan& plan);

/// Returns the fastest drive along the plan (motion/fastest_drive.hpp). A plan whose start is its goal takes
/// no time. Faults: those of fastest_drive(). O(pieces).
Outcome<FastestDrive> fastest_drive(const Plan& plan, const DriveLimits& limits);

}  // namespace outrider
