// Random yards with 100 targets: what is planned is flown again, what is called unreachable is tried again.
#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "support/costly_cases.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::OwnGun;

constexpr double half_side = 6.0;
constexpr std::size_t most_targets = 100;

/// A cat between four walls, some of them high enough to hide it, some roofed.
void add_hut(Rng& rng, GuardProblem& problem, Vec2 at) {
  const double height = rng.uniform(0.5, 2.5);
  for (const double d : {-0.5, 0.5}) {
    problem.world.solids.push_back(box_at("hut", {at.x + d, at.y, 0.5 * height}, {0.05, 1.05, height}));
    problem.world.solids.push_back(box_at("hut", {at.x, at.y + d, 0.5 * height}, {1.05, 0.05, height}));
  }
  if (rng.below(2) == 0) {
    problem.world.solids.push_back(box_at("roof", {at.x, at.y, height + 0.025}, {1.05, 1.05, 0.05}));
  }
  problem.targets.push_back({fmt::format("hidden_{}", problem.targets.size()),
                             {at.x, at.y, 0.0},
                             {0.46, 0.36, 0.178},
                             rng.uniform(-pi, pi)});
}

GuardProblem random_town(Rng& rng) {
  GuardProblem problem = testing::random_guard_problem(rng, 30, 0, half_side);
  std::erase_if(problem.world.solids, [](const Solid& solid) {  // room for the huts, in the corners
    const Vec3 p = solid.world_T_solid.position;
    return solid.name != "floor" && std::max(std::abs(p.x), std::abs(p.y)) > 2.5;
  });
  for (const Vec2 at : {Vec2{-4.5, 4.5}, Vec2{4.5, 4.5}, Vec2{-4.5, -4.0}, Vec2{4.5, -4.0}}) {
    add_hut(rng, problem, at);
  }
  testing::add_targets(rng, problem, most_targets - 2, half_side);
  for (std::size_t i = 0; i < 2; ++i) {
    Target high = problem.targets[10 + i];
    high.name = fmt::format("high_{}", i);
    high.base.z = rng.uniform(3.0, 9.0);
    problem.targets.push_back(high);
  }
  return problem;
}

/// A place between the cells where the robot can stand, joined to a reachable cell by free ground.
Vec2 finer_place(Rng& rng, const GuardProblem& problem, const FiringMap& firing_map,
                 const std::vector<std::size_t>& reachable) {
  const double half = 0.5 * firing_map.frame.resolution_m;
  for (;;) {
    const Vec2 centre =
        firing_map.frame.centre(firing_map.frame.cell(reachable[rng.below(reachable.size())]));
    const Vec2 place = centre + Vec2{rng.uniform(-half, half), rng.uniform(-half, half)};
    if (firing_map.ground.segment_free({centre, place}, problem.robot.radius_m)) return place;
  }
}

/// A point of the target's box, looked at from anywhere.
Vec3 point_of(Rng& rng, const Target& target) {
  const Vec2 forward = direction(target.yaw_rad);
  const Vec2 offset = target.size.x * rng.uniform(-0.5, 0.5) * forward +
                      target.size.y * rng.uniform(-0.5, 0.5) * Vec2{-forward.y, forward.x};
  return {target.base.x + offset.x, target.base.y + offset.y, target.base.z + target.size.z * rng.uniform()};
}

/// Shots from anywhere, at any point, at any pitch: none of them surely hits and keeps the margin.
void expect_out_of_reach(Rng& rng, const GuardProblem& problem, const FiringMap& firing_map, std::size_t t) {
  const Target& target = problem.targets[t];
  const Solid solid = solid_of(target);
  const OwnGun gun{problem.gun};
  std::vector<std::size_t> reachable;
  for (std::size_t i = 0; i < firing_map.reachable.size(); ++i) {
    const double range = distance(firing_map.frame.centre(firing_map.frame.cell(i)), xy(target.base));
    if (firing_map.reachable[i] != 0 && range > firing_map.rules.standoff_m + 0.6) reachable.push_back(i);
  }
  constexpr double step_m = 1e-3;
  for (int i = 0; i < testing::costly_cases(1000); ++i) {
    const Vec2 place = finer_place(rng, problem, firing_map, reachable);
    const Vec3 aim = point_of(rng, target);
    const double pitch = rng.uniform(problem.gun.pitch_low_rad, problem.gun.pitch_high_rad);
    const auto speed = gun.speed(pitch, distance(xy(aim), place), aim.z);
    if (!speed) continue;
    const Shot shot{heading_of(xy(aim) - place), pitch, *speed};
    const auto end = gun.shoot(place, shot, firing_map.space(t).solids(), &solid, -0.5, step_m);
    EXPECT_FALSE(end.hit && end.gap_m > firing_map.rules.margin_m + step_m)
        << target.name << " is hit from " << place.x << ", " << place.y << " at pitch " << degrees(pitch);
  }
}

TEST(HundredTargets, WhatIsPlannedHitsAndWhatIsRefusedIsOutOfReach) {
  Rng rng(100);
  std::size_t refused = 0;
  for (int i = 0; i < cases(1); ++i) {
    const GuardProblem problem = random_town(rng);
    ASSERT_EQ(problem.targets.size(), most_targets);
    GuardOptions options = testing::from_rest();
    options.stops = 150;
    options.iterations = 100;
    options.refinements = 1;
    options.gap = 1.0;
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const auto plan = plan_guard(problem, *firing_map, options, {});
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    EXPECT_GT(plan->lower_bound_s, 0.0);
    EXPECT_LE(plan->lower_bound_s, plan->bounded_s() + 1e-9);
    EXPECT_NEAR(plan->cost_s, testing::own_cost(problem, *plan), 1e-6);

    std::size_t planned = 0;
    for (const PlannedStop& stop : plan->stops) {
      for (const PlannedHit& hit : stop.hits) {
        ++planned;
        const Solid target = solid_of(problem.targets[hit.target]);
        const auto end = OwnGun{problem.gun}.shoot(stop.position, hit.shot.shot,
                                                   firing_map->space(hit.target).solids(), &target, -1.0);
        EXPECT_TRUE(end.hit) << i << ": " << problem.targets[hit.target].name;
      }
    }
    EXPECT_EQ(planned + plan->unreachable.size(), most_targets);
    for (const Unreachable& lost : plan->unreachable) {
      EXPECT_FALSE(lost.reason.empty());
      expect_out_of_reach(rng, problem, *firing_map, lost.target);
    }
    refused += plan->unreachable.size();
    RecordProperty(fmt::format("gap_{}", i), fmt::format("{:.3f}", plan->gap()));
  }
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace outrider
