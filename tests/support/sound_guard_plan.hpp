// The promises of every guard planner, judged by other means than those of the planners.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "support/guard_yard.hpp"

namespace outrider::testing {

/// Expects that each target is in one stop or unreachable, each leg is free, each shot hits with the margin,
/// and the cost is the sum of its parts.
inline void expect_sound(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                         const GuardOptions& options, const std::string& what) {
  std::vector<int> times(problem.targets.size(), 0);
  for (const Unreachable& lost : plan.unreachable) {
    ++times[lost.target];
    EXPECT_FALSE(lost.reason.empty()) << what;
  }
  Vec2 at = problem.start.position;
  for (const PlannedStop& stop : plan.stops) {
    ASSERT_FALSE(stop.waypoints.empty()) << what;
    EXPECT_LT(distance(stop.waypoints.front(), at), 1e-9) << what;
    EXPECT_LT(distance(stop.waypoints.back(), stop.position), 1e-9) << what;
    at = stop.position;
    for (std::size_t i = 1; i < stop.waypoints.size(); ++i) {
      for (int k = 0; k <= 100; ++k) {
        const Vec2 p = stop.waypoints[i - 1] + k / 100.0 * (stop.waypoints[i] - stop.waypoints[i - 1]);
        EXPECT_GE(firing_map.ground.clearance(p, 1.0), problem.robot.radius_m - 2e-9) << what;
      }
    }
    EXPECT_FALSE(stop.hits.empty()) << what;
    for (const PlannedHit& hit : stop.hits) {
      ++times[hit.target];
      const Solid target = solid_of(problem.targets[hit.target]);
      const auto end = OwnGun{problem.gun}.shoot(stop.position, hit.shot.shot,
                                                 firing_map.space(hit.target).solids(), &target, -1.0);
      EXPECT_TRUE(end.hit) << what << ": " << problem.targets[hit.target].name;
      EXPECT_NEAR(end.time_s, hit.shot.flight_s, 2e-4) << what;
      EXPECT_GE(end.gap_m, options.margin_m - 3e-4) << what;
    }
  }
  for (const int count : times) EXPECT_EQ(count, 1) << what;
  EXPECT_NEAR(plan.cost_s, own_cost(problem, plan), 1e-6) << what;
  EXPECT_LE(plan.lower_bound_s, plan.bounded_s() + 1e-9) << what;
}

}  // namespace outrider::testing
