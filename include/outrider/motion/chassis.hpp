// Chassis: forward and inverse kinematics of wheeled robots.
//
// A wheel that rolls without slip has a speed that is linear in the twist of the body, so a chassis is a
// matrix with one row of three factors for each wheel. Its columns are orthogonal for all three kinds, so the
// least-squares twist for given wheel speeds is a projection on each column. The residual, which four mecanum
// wheels can have, is slip.
//
//   differential   two wheels abreast; does not move sideways
//   mecanum        four wheels with rollers at 45 degrees, [fl fr bl br] =
//                  1/r [[1, -1, -l], [1, 1, l], [1, 1, -l], [1, -1, l]] [ahead left turn]
//   holonomic      a disk on three omnidirectional wheels, 120 degrees apart, the first ahead
//
// Units: m, rad/s, rad/s per m/s. O(wheels). Sources: Lynch and Park, Modern Robotics, section 13.2;
// Taheri, Qiao and Ghaeminezhad, Kinematic model of a four mecanum wheeled mobile robot (2015).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

inline constexpr std::size_t most_wheels = 4;
/// Holds one number for each wheel, in the order of the chassis; the rest is 0.
using WheelSpeeds4 = std::array<double, most_wheels>;

/// A wheel: the factors by which its speed depends on the twist of the body.
struct Wheel {
  std::string_view name;
  double per_ahead = 0.0;  ///< rad/s of the wheel per m/s of the body
  double per_left = 0.0;   ///< rad/s per m/s
  double per_turn = 0.0;   ///< rad/s per rad/s
};

/// A chassis.
struct Chassis {
  std::string_view kind;
  std::vector<Wheel> wheels;  ///< at most most_wheels
  [[nodiscard]] bool moves_sideways() const;
};

/// Makes a differential chassis. `half_track_m` is half the distance between the wheels.
Chassis differential_chassis(double wheel_radius_m, double half_track_m);
/// Makes a mecanum chassis. `half_size_m` is half the length plus half the width between the wheels.
Chassis mecanum_chassis(double wheel_radius_m, double half_size_m);
/// Makes a holonomic chassis. `ring_radius_m` is the distance from the centre to each wheel.
Chassis holonomic_chassis(double wheel_radius_m, double ring_radius_m);

/// Makes a chassis by the name of its kind; `reach_m` is the half track, half size or ring radius. Fault:
/// bad_input for another kind.
Outcome<Chassis> make_chassis(std::string_view kind, double wheel_radius_m, double reach_m);

/// Inverse kinematics: returns the wheel speeds of a twist. Ignores sideways motion if the chassis cannot do
/// it.
WheelSpeeds4 wheel_speeds(const Chassis& chassis, const Twist2& twist);

/// Forward kinematics: returns the least-squares twist for given wheel speeds.
Twist2 twist_of(const Chassis& chassis, const WheelSpeeds4& speeds);

}  // namespace outrider
