// Hits a target behind a wall: the shot, its clearance, and the flight.
#include <fmt/format.h>

#include <algorithm>

#include "outrider/ballistics/shot.hpp"

using namespace outrider;

int main() {
  const Solid wall{"wall", {{2.0, 0.0, 0.4}, {}}, BoxShape{{0.05, 2.0, 0.4}}};
  const FlightSpace space({wall});
  const Target cat{"cat", {4.0, 0.0, 0.0}, {0.5, 0.2, 0.4}};
  const ShotRules rules;  // a gun of 10 m/s that stays 0.03 m away from everything
  const Vec2 stand{0.0, 0.0};

  const auto shot = best_shot(rules, space, cat, stand, /*pitch_rad=*/0.0);
  if (!shot) return 1;
  const Flight flight = launch(rules.gun, stand, rules.floor_z_m, shot->shot, rules.gravity_mps2);
  double top_m = 0.0;
  for (int i = 0; i <= 100; ++i) top_m = std::max(top_m, flight.position(0.01 * i * shot->flight_s).z);

  fmt::print("pitch {:.1f} degrees, {:.2f} m/s\n", degrees(shot->shot.pitch_rad), shot->shot.speed_mps);
  fmt::print("in the air for {:.2f} s, up to {:.2f} m, {:.2f} m clear of the wall\n", shot->flight_s, top_m,
             shot->clearance_m);
  const Impact impact = fly(flight, rules.gun.ball_radius_m, space, cat, rules.floor_z_m);
  fmt::print("flown exactly: {}\n", impact.hit ? "hit" : "miss");
}

// Prints:
// pitch 31.5 degrees, 6.36 m/s
// in the air for 0.65 s, up to 0.84 m, 0.03 m clear of the wall
// flown exactly: hit
