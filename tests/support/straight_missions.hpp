// Missions of random straight drives that shoot in passing, for tests of lower bounds.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider::testing {

/// The time of a straight drive from rest until `way_m` of its `length_m`; the last drive of a mission is
/// longer.
inline double time_at(const RobotModel& robot, double way_m, double length_m) {
  const double a = robot.acceleration_mps2, v = robot.speed_mps;
  const double speed_up_m = std::min(0.5 * v * v / a, 0.5 * length_m);
  if (way_m <= speed_up_m) return std::sqrt(2.0 * way_m / a);
  return own_duration(length_m, v, a) -
         (length_m - way_m <= speed_up_m
              ? std::sqrt(2.0 * (length_m - way_m) / a)
              : std::sqrt(2.0 * speed_up_m / a) +
                    (length_m - way_m - speed_up_m) / std::min(v, std::sqrt(a * length_m)));
}

/// A mission of random straight drives, some of them short, that fires at each target in the first cell of
/// its region; infinite where that takes longer than `most_s`.
inline double random_mission(const GuardProblem& problem, const FiringMap& firing_map,
                             const std::vector<std::vector<std::size_t>>& regions, Rng& rng, double most_s) {
  const RobotModel& robot = problem.robot;
  const GridFrame& frame = firing_map.frame;
  std::vector<std::uint8_t> left(problem.targets.size(), 0);
  std::size_t count = 0;
  for (std::size_t t = 0; t < regions.size(); ++t) {
    left[t] = regions[t].empty() ? 0 : 1;
    count += left[t];
  }
  const auto fire = [&](Vec2 place) {
    const std::size_t cell = frame.index(frame.cell_at(place));
    for (std::size_t t = 0; t < left.size(); ++t) {
      if (left[t] == 0 || firing_map.regions[t].pitch[cell] == FiringRegion::no_shot) continue;
      left[t] = 0;
      --count;
    }
  };
  Pose2 pose = problem.start;
  fire(pose.position);
  double time_s = 0.0;
  for (int tried = 0; count > 0 && time_s < most_s && tried < 60; ++tried) {
    std::size_t t = 0;
    do t = static_cast<std::size_t>(rng.uniform() * static_cast<double>(left.size()));
    while (left[t] == 0);
    const std::size_t cell =
        regions[t][static_cast<std::size_t>(rng.uniform() * static_cast<double>(regions[t].size()))];
    const Vec2 goal = frame.centre(frame.cell(cell));
    const double part = rng.uniform() < 0.1 ? rng.uniform(0.0, 0.02) : rng.uniform(0.7, 1.05);
    const Vec2 aside = 0.3 * Vec2{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)};
    const Vec2 to = pose.position + part * (goal + (rng.uniform() < 0.5 ? aside : Vec2{}) - pose.position);
    const double length = distance(pose.position, to);
    if (length < 1e-6 || !firing_map.ground.segment_free({pose.position, to}, robot.radius_m)) continue;
    const double heading = heading_of(to - pose.position);
    time_s += own_duration(std::abs(wrap_angle(heading - pose.heading_rad)), robot.turn_rate_radps,
                           robot.turn_acceleration_radps2);
    for (double way = 0.0; way <= length; way += 0.005) {
      fire(pose.position + way / length * (to - pose.position));
      if (count == 0) return time_s + time_at(robot, way, 1e6);
    }
    time_s += own_duration(length, robot.speed_mps, robot.acceleration_mps2);
    pose = {to, heading};
  }
  return count == 0 ? time_s : std::numeric_limits<double>::infinity();
}

/// How near a bound comes to missions of random straight drives.
struct Tightness {
  double mean = 0.0;  // of the bound over the time of the best mission
  int yards = 0;
};

/// Compares `bound(problem, firing_map, targets, options)` with the best of 3,000 random missions in each of
/// some yards, none of which it may exceed.
template <class Bound>
Tightness compare_with_random_missions(const Bound& bound) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Rng rng(88);
  Tightness tightness;
  for (int i = 0; i < cases(20); ++i) {
    auto problem = random_guard_problem(rng, i % 2 == 0 ? 0 : 8, 1 + static_cast<std::size_t>(i) % 3, 3.0);
    problem.gun.muzzle_speed_mps = rng.uniform(2.0, 3.5);
    problem.robot.acceleration_mps2 = i % 5 == 0 ? 5.0 : rng.uniform(0.3, 1.5);
    problem.start.heading_rad = rng.uniform(-pi, pi);
    GuardOptions options;
    options.resolution_m = rng.uniform(0.08, 0.3);
    const auto firing_map = build_firing_map(problem, options);
    EXPECT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    if (!firing_map) return {};
    std::vector<std::size_t> targets;
    std::vector<std::vector<std::size_t>> regions(problem.targets.size());
    for (std::size_t t = 0; t < firing_map->regions.size(); ++t) {
      for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
        if (firing_map->regions[t].pitch[c] != FiringRegion::no_shot) regions[t].push_back(c);
      }
      if (!regions[t].empty()) targets.push_back(t);
    }
    if (targets.empty()) continue;
    const double bound_s = bound(problem, *firing_map, targets, options);
    double best = inf;
    for (int k = 0; k < 3000; ++k)
      best = std::min(best, random_mission(problem, *firing_map, regions, rng, best));
    EXPECT_LE(bound_s, best + 1e-9) << "yard " << i;
    if (best == 0.0 || best == inf) continue;
    tightness.mean += bound_s / best;
    ++tightness.yards;
  }
  if (tightness.yards > 0) tightness.mean /= tightness.yards;
  return tightness;
}

}  // namespace outrider::testing
