#include "research/guard/heading_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/motion/profile.hpp"
#include "research/guard/heading_plan.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"
#include "support/straight_missions.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::random_guard_problem;

constexpr double plenty_bytes = 1e9;

GuardOptions fine_options() {
  GuardOptions options;
  options.resolution_m = 0.1;
  return options;
}

/// An open yard with one target, and a robot that looks away from it.
GuardProblem target_behind(Rng& rng) {
  auto problem = random_guard_problem(rng, 0, 1, 4.0);
  problem.gun.muzzle_speed_mps = rng.uniform(2.5, 3.5);
  const Vec2 away = problem.start.position - xy(problem.targets[0].base);
  problem.start.heading_rad = heading_of(away) + rng.uniform(-0.5, 0.5);
  return problem;
}

/// The robot may be anywhere with any of `targets` targets left.
HeadingLimits unlimited(const FiringMap& firing_map, std::size_t targets) {
  const GridWindow all{{0, 0}, firing_map.frame.width, firing_map.frame.height};
  return {1e3, std::vector<GridWindow>(std::size_t{1} << targets, all)};
}

/// The least time to turn and drive straight into the region, without an end of the drive.
double least_time(const GuardProblem& problem, const FiringMap& firing_map) {
  const RobotModel& robot = problem.robot;
  const double v = robot.speed_mps, a = robot.acceleration_mps2;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < firing_map.frame.size(); ++c) {
    if (firing_map.regions[0].pitch[c] == FiringRegion::no_shot) continue;
    const Vec2 corner = firing_map.frame.corner(firing_map.frame.cell(c));
    for (int k = 0; k < 9; ++k) {
      const Vec2 inside = 0.5 * firing_map.frame.resolution_m * Vec2{k % 3 * 0.999, k / 3 * 0.999};
      const Vec2 way = corner + inside - problem.start.position;
      const double turn = std::abs(wrap_angle(heading_of(way) - problem.start.heading_rad));
      const double length = norm(way);
      const double drive = length < 0.5 * v * v / a ? std::sqrt(2.0 * length / a) : length / v + 0.5 * v / a;
      least = std::min(least, duration(turn, robot.turning()) + drive);
    }
  }
  return least;
}

TEST(ResearchHeadingBound, IsCloseToTheLeastTurnAndDriveToOneTarget) {
  Rng rng(411);
  int yards = 0;
  double tightness = 0.0;
  for (int i = 0; i < cases(10); ++i) {
    const GuardProblem problem = target_behind(rng);
    const auto firing_map = build_firing_map(problem, fine_options());
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    if (firing_map->regions[0].hits == 0) continue;
    const double best = least_time(problem, *firing_map);
    if (best < 3.0) continue;
    const double bound =
        heading_bound(problem, *firing_map, {0}, unlimited(*firing_map, 1), plenty_bytes, {});
    EXPECT_LE(bound, best + 1e-9) << "yard " << i;
    tightness += bound / best;
    ++yards;
  }
  EXPECT_GT(yards, 4);
  EXPECT_GT(tightness / yards, 0.8);
}

TEST(ResearchHeadingBound, IsAtMostTheLimitAndNothingWhereItCannotBeFound) {
  Rng rng(412);
  GuardProblem problem = target_behind(rng);
  const auto firing_map = build_firing_map(problem, fine_options());
  ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  ASSERT_GT(firing_map->regions[0].hits, 0U);
  HeadingLimits limits = unlimited(*firing_map, 1);
  const double bound = heading_bound(problem, *firing_map, {0}, limits, plenty_bytes, {});
  ASSERT_GT(bound, 1.0);
  EXPECT_EQ(heading_bound(problem, *firing_map, {0}, limits, 1000.0, {}), 0.0);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(heading_bound(problem, *firing_map, {0}, limits, plenty_bytes, stop.get_token()), 0.0);
  limits.most_s = 0.5 * bound;
  EXPECT_EQ(heading_bound(problem, *firing_map, {0}, limits, plenty_bytes, {}), 0.5 * bound);
  problem.robot.acceleration_mps2 = 1000.0;
  EXPECT_EQ(heading_bound(problem, *firing_map, {0}, unlimited(*firing_map, 1), plenty_bytes, {}), 0.0);
}

TEST(ResearchHeadingBound, IsNeverAboveAMissionOfStraightDrives) {
  const auto [mean, yards] = testing::compare_with_random_missions(
      [](const auto& problem, const auto& firing_map, const auto& targets, const auto& options) {
        const double bound = heading_mission_bound(problem, firing_map, targets, options, {});
        EXPECT_GE(bound, mission_bound(problem, firing_map, targets, options, {}));
        return bound;
      });
  EXPECT_GT(yards, 10);
  EXPECT_GT(mean, 0.6);
}

}  // namespace
}  // namespace outrider
