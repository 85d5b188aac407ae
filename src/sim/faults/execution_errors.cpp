#include "outrider/sim/faults/execution_errors.hpp"

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {

std::vector<Option> describe(ExecutionErrors& errors) {
  return {
      {"position", "m", 0.0, 10.0, "largest distance from the goal of a drive to where it ends",
       &errors.position_m},
      {"heading", "rad", 0.0, 1.0, "largest error of the heading there", &errors.heading_rad},
      {"gun", "rad", 0.0, 1.0, "largest error of the barrel's yaw and pitch", &errors.aim.gun_rad},
      {"speed", "", 0.0, 0.5, "largest error of the muzzle speed, as a part of it", &errors.aim.speed_ratio},
      {"timing", "s", 0.0, 1.0, "largest error of the moment of a shot from a robot that drives",
       &errors.timing_s},
  };
}

Vec2 random_in_disk(Rng& rng, double radius_m) {
  const double r = radius_m * std::sqrt(rng.uniform());
  return r * direction(rng.uniform(0.0, 2.0 * pi));
}

Vec2 displaced_goal(const std::vector<Vec2>& waypoints, double radius_m, const CollisionMap& ground,
                    const ShotRules& rules, Vec2 error) {
  constexpr double least_m2 = 1e-12;
  const Vec2 before = waypoints[waypoints.size() - 2];
  const Vec2 goal = waypoints.back();
  const Stance there = stance_at(rules, goal);
  if (!there.level()) error = xy(leaning(there.up) * Vec3{error.x, error.y, 0.0});
  while (squared_norm(error) > least_m2 && !ground.segment_free({before, goal + error}, radius_m)) {
    error = 0.5 * error;
  }
  return squared_norm(error) > least_m2 ? goal + error : goal;
}

Shot shot_with_errors(const Shot& meant, const AimErrors& errors, Rng& rng, const Stance& stance) {
  const double yaw = errors.gun_rad * rng.uniform(-1.0, 1.0);
  const double pitch = errors.gun_rad * rng.uniform(-1.0, 1.0);
  Shot shot = off_by(stance, meant, yaw, pitch);
  shot.speed_mps = meant.speed_mps * (1.0 + errors.speed_ratio * rng.uniform(-1.0, 1.0));
  return shot;
}

}  // namespace outrider
