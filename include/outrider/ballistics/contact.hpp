// What a ball in flight touches first, and how near it comes to anything.
//
// Both are found by conservative advancement (Mirtich 1996; Zhang, Lee and Kim 2006): the ball cannot
// reach a solid sooner than its distance divided by its speed allows, so stepping by that time skips
// nothing, however thin. The distances are exact, so answers are exact up to `contact_tolerance_m`.
#pragma once

#include <optional>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// A ball within this distance of a solid touches it.
inline constexpr double contact_tolerance_m = 1e-6;

/// Earliest time in [from_s, until_s] at which a ball of that radius touches the solid.
std::optional<double> contact_time(const Flight& flight, double ball_radius_m, const Solid& solid,
                                   double from_s, double until_s);

/// Whether it touches it at any time in there, sooner told than when: each look at the middle of what is left
/// settles the times around it that the ball's distance allows for.
bool touches(const Flight& flight, double ball_radius_m, const Solid& solid, double from_s, double until_s);

struct Contact {
  double time_s = 0.0;
  std::size_t solid = 0;  ///< index in the FlightSpace
  Vec3 position;          ///< centre of the ball then
};

struct Clearance {
  double distance_m = 0.0;  ///< from the ball's surface; negative is not told from 0
  double time_s = 0.0;      ///< where on the flight
  std::size_t solid = 0;
};

/// Solids ready for many flights: each flight looks closely only at those whose boxes it passes.
class FlightSpace {
 public:
  explicit FlightSpace(std::vector<Solid> solids);

  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

  /// First contact with any solid until `until_s`; ties go to the solid listed first. O(solids).
  [[nodiscard]] std::optional<Contact> first_contact(const Flight& flight, double ball_radius_m,
                                                     double until_s) const;
  /// Nearest approach of the ball's surface to any solid until `until_s`, to 0.1 mm, cut off at
  /// `most_m` (time and solid are 0 then). Branch and bound on time with the speed as Lipschitz constant.
  [[nodiscard]] Clearance clearance(const Flight& flight, double ball_radius_m, double until_s,
                                    double most_m) const;

 private:
  std::vector<Solid> solids_;
  std::vector<Box3> boxes_;
};

/// The time at which a flight has fallen to `height_m` for good; 0 when it never rises to it.
double fall_time(const Flight& flight, double height_m);

}  // namespace outrider
