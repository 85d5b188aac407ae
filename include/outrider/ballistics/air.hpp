// Air: what slows a ball down and carries it sideways.
//
// A ball of velocity v in wind w, with u = v - w, is accelerated by
//     v' = g - c |u| u,   c = (air density) x (drag coefficient) x (cross section) / (2 x mass);
// a ball of water of 1 cm has c = 0.02 1/m. The wind is horizontal and the same everywhere.
//
// The path has no closed form. AirTrack gives it in pieces: the velocity is a cubic in each, with the right
// acceleration at both ends, and the position is its integral. Its defect, the most by which its
// acceleration is off the law, is bounded piece by piece: looked at in the middle, and between by the
// third derivative of the law along the piece, which is known. Two velocities under the law never move apart
// (u -> |u| u is monotone), so after a time t the position is off by at most defect x t^2 / 2.
// Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, I.10 and II.6.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/box.hpp"

namespace outrider {

struct Air {
  double drag_per_m = 0.0;  ///< c; 0: no air, whatever the wind
  double wind_mps = 0.0;
  double wind_towards_rad = 0.0;  ///< where it blows to, counter-clockwise from +x

  /// Flights are parabolas.
  [[nodiscard]] bool none() const { return drag_per_m == 0.0; }
  [[nodiscard]] Vec3 wind() const;
  /// Returns the acceleration, m/s2, of a ball with velocity `u`, m/s, through the air.
  [[nodiscard]] Vec3 acceleration(Vec3 u, double gravity_mps2) const;
};

std::vector<Option> describe(Air& air);

/// The path of a ball in air, from the muzzle until it falls below a height; from there it goes straight on.
class AirTrack {
 public:
  /// The defect is at most `accuracy` times the acceleration at the muzzle; the usual one makes that 1
  /// micrometre after 1.5 s. O(pieces), of which there are about 100 a second; a thousand times the defect
  /// takes a tenth of them. Gravity is above 0.
  AirTrack(const Air& air, Vec3 muzzle, Vec3 velocity_mps, double gravity_mps2, double lowest_z_m,
           double accuracy = 5e-8);

  [[nodiscard]] Vec3 position(double time_s) const;
  [[nodiscard]] Vec3 velocity(double time_s) const;
  [[nodiscard]] double defect_mps2() const { return defect_mps2_; }
  /// Bound of the acceleration's size at any time.
  [[nodiscard]] double most_acceleration() const { return most_acceleration_; }
  [[nodiscard]] double end_s() const { return pieces_.back().start_s; }
  /// When it is highest.
  [[nodiscard]] double top_s() const;
  /// The time at which it has fallen to that height for good; 0 when it never rises to it.
  [[nodiscard]] double fall_time(double height_m) const;
  /// A part of [from_s, until_s] that holds all times at which the ball's centre is in the box; nothing
  /// when there are none.
  [[nodiscard]] std::optional<std::pair<double, double>> passage(const Box3& box, double from_s,
                                                                 double until_s) const;

 private:
  struct Piece {
    double start_s = 0.0;
    Vec3 position, velocity, acceleration, jerk, snap;  ///< at its start; the snap stays

    [[nodiscard]] Vec3 position_after(double s) const;
    [[nodiscard]] Vec3 velocity_after(double s) const;
  };
  /// Some pieces in a row, and a box around them.
  struct Block {
    double end_s = 0.0;
    Box3 box;
  };
  [[nodiscard]] const Piece& at(double time_s) const;
  void wrap();

  double defect_mps2_ = 0.0;
  double most_acceleration_ = 0.0;
  std::vector<Piece> pieces_;  ///< the last one has no end
  std::vector<Block> blocks_;
};

}  // namespace outrider
