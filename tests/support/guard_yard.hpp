// Small guard problems, and what a plan costs by another count.
#pragma once

#include <cmath>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "support/fine_flight.hpp"
#include "support/random_yard.hpp"

namespace outrider::testing {

/// Plans that stand still to shoot and wait for each ball.
inline GuardOptions from_rest() {
  GuardOptions options;
  options.shoot_on_the_move = false;
  return options;
}

/// The same, coarse enough that a small yard is planned in milliseconds.
inline GuardOptions quick() {
  GuardOptions options = from_rest();
  options.resolution_m = 0.15;
  options.stops = 60;
  options.iterations = 200;
  return options;
}

inline GuardOptions quick_on_the_move() {
  GuardOptions options = testing::quick();
  options.shoot_on_the_move = true;
  return options;
}

/// Targets left and right of a street, the last at its end.
inline GuardProblem street() {
  GuardProblem problem;
  problem.world.bounds = {{-1, -4}, {16, 4}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, 0}, 0.0};
  for (int i = 0; i < 5; ++i) {
    problem.targets.push_back(
        {fmt::format("cat_{}", i), {2.0 + 2.9 * i, i % 2 == 0 ? 2.0 : -2.4, 0.0}, {0.5, 0.3, 0.45}, 0.4 * i});
  }
  return problem;
}

/// Targets at free places until there are so many, away from the start.
inline void add_targets(Rng& rng, GuardProblem& problem, std::size_t targets, double half_side) {
  while (problem.targets.size() < targets) {
    Target target = random_small_yard(rng, 0, 1.0).target;
    target.base = {rng.uniform(-0.8, 0.8) * half_side, rng.uniform(-0.8, 0.8) * half_side, target.base.z};
    target.name = fmt::format("cat_{}", problem.targets.size());
    bool free = distance(xy(target.base), problem.start.position) > 1.2;
    for (const Solid& solid : problem.world.solids) free = free && distance(target.centre(), solid) > 0.05;
    if (free) problem.targets.push_back(std::move(target));
  }
}

/// A walled yard of 2 x half_side with some solids and targets; the start is at its south.
inline GuardProblem random_guard_problem(Rng& rng, std::size_t solids, std::size_t targets,
                                         double half_side) {
  GuardProblem problem;
  problem.world.name = "yard";
  problem.world.bounds = {{-half_side, -half_side}, {half_side, half_side}};
  problem.world.solids = {floor_at(0.0)};
  problem.start = {{0.0, -half_side + 0.35}, radians(90.0)};
  const auto far_from_start = [&](Vec3 p) { return distance(xy(p), problem.start.position) > 1.2; };
  while (problem.world.solids.size() <= solids) {
    Solid solid = random_solid(rng, rng.below(7), half_side);
    if (!far_from_start(solid.world_T_solid.position)) continue;
    solid.name += fmt::format("_{}", problem.world.solids.size());
    problem.world.solids.push_back(std::move(solid));
  }
  add_targets(rng, problem, targets, half_side);
  return problem;
}

/// Time from rest to rest under a limit of speed and of acceleration.
inline double own_duration(double way, double speed, double acceleration) {
  const double ramp = speed * speed / acceleration;  // to speed up and to slow down
  return way >= ramp ? way / speed + speed / acceleration : 2.0 * std::sqrt(way / acceleration);
}

inline double own_angle(double a) { return std::abs(std::atan2(std::sin(a), std::cos(a))); }

/// The time of a plan, added up from its waypoints and shots alone.
inline double own_cost(const GuardProblem& problem, const GuardPlan& plan) {
  const RobotModel& robot = problem.robot;
  double time = 0.0;
  double heading = problem.start.heading_rad;
  double barrel = heading;  // in the world; it turns with the body
  double pitch = 0.0;
  for (const PlannedStop& stop : plan.stops) {
    for (std::size_t i = 1; i < stop.waypoints.size(); ++i) {
      const Vec2 leg = stop.waypoints[i] - stop.waypoints[i - 1];
      if (norm(leg) == 0.0) continue;
      const double next = std::atan2(leg.y, leg.x);
      time += own_duration(own_angle(next - heading), robot.turn_rate_radps, robot.turn_acceleration_radps2);
      time += own_duration(norm(leg), robot.speed_mps, robot.acceleration_mps2);
      barrel += next - heading;
      heading = next;
    }
    for (const PlannedHit& hit : stop.hits) {
      const Shot& shot = hit.shot.shot;
      time += std::max(own_angle(shot.yaw_rad - barrel) / problem.gun.yaw_rate_radps,
                       std::abs(shot.pitch_rad - pitch) / problem.gun.pitch_rate_radps);
      time += hit.shot.flight_s;
      barrel = shot.yaw_rad;
      pitch = shot.pitch_rad;
    }
  }
  return time;
}

}  // namespace outrider::testing
