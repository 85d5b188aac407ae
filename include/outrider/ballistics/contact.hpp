// The first contact of a ball in flight, and its clearance from the solids.
//
// Both use conservative advancement (Mirtich 1996; Zhang, Lee and Kim 2006): the ball needs at least distance
// / speed to reach a solid, so steps of that duration never miss a solid, however thin. Distances are exact,
// so results are exact up to `contact_tolerance_m`.
#pragma once

#include <optional>
#include <vector>

#include "outrider/ballistics/box_tree.hpp"
#include "outrider/ballistics/flight.hpp"
#include "outrider/ballistics/mesh_tree.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// A ball within this distance of a solid touches it.
inline constexpr double contact_tolerance_m = 1e-6;

/// Returns the earliest time in [from_s, until_s] at which the ball touches the solid; nothing if it does
/// not.
std::optional<double> contact_time(const Flight& flight, double ball_radius_m, const Solid& solid,
                                   double from_s, double until_s);

/// Returns true if the ball touches the solid within [from_s, until_s]. Faster than contact_time(): it
/// bisects, and skips every sub-interval at whose middle the ball is farther away than it can travel within
/// the sub-interval.
bool touches(const Flight& flight, double ball_radius_m, const Solid& solid, double from_s, double until_s);

/// A contact of a ball with a solid.
struct Contact {
  double time_s = 0.0;
  std::size_t solid = 0;  ///< index in the FlightSpace
  Vec3 position;          ///< centre of the ball at the contact
};

/// The nearest approach of a ball to a solid.
struct Clearance {
  double distance_m = 0.0;  ///< distance from the surface of the ball; 0 if they overlap
  double time_s = 0.0;      ///< time of the nearest approach
  std::size_t solid = 0;    ///< index in the FlightSpace
};

/// Solids preprocessed for many flights. A flight is tested only against solids whose bounding boxes it
/// passes, and against the triangles of meshes that are near.
class FlightSpace {
 public:
  explicit FlightSpace(std::vector<Solid> solids);

  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

  /// Returns the first contact with any solid until `until_s`. For equal times the solid listed first wins.
  /// O(log(solids) + solids near the flight).
  [[nodiscard]] std::optional<Contact> first_contact(const Flight& flight, double ball_radius_m,
                                                     double until_s) const;
  /// Returns the nearest approach of the ball's surface to any solid until `until_s`, accurate to 0.1 mm. The
  /// distance is cut off at `most_m`; time and solid are 0 then. Branch and bound over time, with the speed
  /// as Lipschitz constant.
  [[nodiscard]] Clearance clearance(const Flight& flight, double ball_radius_m, double until_s,
                                    double most_m) const;

 private:
  [[nodiscard]] double distance_to(std::size_t solid, Vec3 p) const;

  std::vector<Solid> solids_;
  std::vector<Box3> boxes_;
  BoxTree tree_;
  std::vector<std::optional<MeshTree>> meshes_;  // by solid: those that are meshes
};

/// Returns the last time at which the flight is at `height_m`, on its way down; 0 if it never reaches that
/// height.
double fall_time(const Flight& flight, double height_m);

}  // namespace outrider
