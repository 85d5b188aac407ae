// FastestDrive: the least time in which a robot drives a given path, and its speed along it.
//
// The path is a chain of pieces of constant curvature: straight legs and arcs. The robot begins and ends at
// rest, and comes to rest at stops between pieces, where it may turn in place. On a piece of curvature k,
// 1/m, the speed v and the acceleration a along the path keep
//   v <= speed,  |k| v <= turn rate,  |k| v^2 <= lateral acceleration,  -deceleration <= a <= acceleration.
// A turn in place is a trapezoidal motion of the turn rate and the turn acceleration (profile.hpp).
//
// On each piece the limits are constants, so v^2 is linear in the distance while the robot accelerates or
// brakes. A backward pass computes the largest v^2 at the end of each piece from which the rest can be
// driven, a forward pass limits it to what can be reached, and the points where the robot stops accelerating
// and starts to brake follow in closed form: nothing is sampled. No speed that keeps the limits is above the
// one returned at any place of the path, so none takes less time. Exact apart from rounding.
//
// Trap: the turn acceleration holds for turns in place only. Where curvature jumps between a leg and an arc
// the turn rate of the robot, and the angle of wheels that steer, jump too: a real robot needs more time
// there or leaves the path. control/speed_profile.hpp has the profile of a path whose curvature does not
// jump.
//
// Sources: Bobrow, Dubowsky and Gibson, Time-optimal control of robotic manipulators along specified paths,
// International Journal of Robotics Research 4 (1985); Verscheure, Demeulenaere, Swevers, De Schutter and
// Diehl, Time-optimal path tracking for robots: a convex optimization approach, IEEE Transactions on
// Automatic Control 54 (2009), for v^2 as the variable. Thread rule: pure functions.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {

/// Limits of a robot on a path.
struct DriveLimits {
  double speed_mps = 0.8;                  ///< maximum speed
  double acceleration_mps2 = 0.8;          ///< maximum acceleration along the path
  double deceleration_mps2 = 0.8;          ///< maximum deceleration along the path
  double lateral_acceleration_mps2 = 0.8;  ///< maximum acceleration across the path: speed^2 * curvature
  double turn_rate_radps = 0.8;            ///< maximum turn rate, on arcs and in place
  double turn_acceleration_radps2 = 6.0;   ///< maximum angular acceleration of turns in place

  [[nodiscard]] Limits turning() const { return {turn_rate_radps, turn_acceleration_radps2}; }
};

/// Returns the options; they point into `limits`.
std::vector<Option> describe(DriveLimits& limits);
/// Checks the ranges of describe(). Fault: bad_input with the name of the limit, its value and its range.
Status check(const DriveLimits& limits);

/// A piece of constant curvature, and what the robot does before it.
struct CurvePiece {
  double length_m = 0.0;         ///< from 0 to 1e9
  double curvature_per_m = 0.0;  ///< 1 / radius, at most 1e12; its sign does not matter
  bool stop = false;             ///< the robot comes to rest at the beginning of the piece
  double turn_rad = 0.0;         ///< turn in place there; if it is not 0, the robot stops for it
};

/// A part of a drive with one acceleration, or a turn in place.
struct DrivePhase {
  double start_s = 0.0;
  double duration_s = 0.0;
  double start_m = 0.0;            ///< distance along the path at the start of the phase
  double speed_mps = 0.0;          ///< speed at the start of the phase
  double acceleration_mps2 = 0.0;  ///< along the path; negative: brakes
  double turn_rad = 0.0;           ///< angle of a turn in place; 0 on the way
};

/// The fastest drive along a path.
struct FastestDrive {
  std::vector<DrivePhase> phases;  ///< one after the other; none takes no time
  double time_s = 0.0;
  double driven_m = 0.0;
  double turned_rad = 0.0;  ///< sum of the turns in place
};

/// Returns the fastest drive along the pieces. Faults: bad_input for limits out of range and for a piece
/// whose numbers are out of range or not finite, with its index. O(pieces), at most four phases for each
/// piece.
Outcome<FastestDrive> fastest_drive(const std::vector<CurvePiece>& pieces, const DriveLimits& limits);

/// The distance of a robot along its path, and its speed.
struct DriveState {
  double along_m = 0.0;
  double speed_mps = 0.0;
};
/// Returns the state at a time; at rest before the start and after the end. O(log phases).
DriveState state_at(const FastestDrive& drive, double time_s);

}  // namespace outrider
