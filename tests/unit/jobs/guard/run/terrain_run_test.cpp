#include <gtest/gtest.h>

#include "outrider/ballistics/stance.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/random_cases.hpp"
#include "support/random_terrain.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::coarse;
using testing::hill;
using testing::terrain_of;
using testing::YardRun;

YardRun run_of(const GuardProblem& problem, std::uint64_t seed, bool on_the_move = false) {
  GuardOptions options = coarse();
  options.shoot_on_the_move = on_the_move;
  return testing::run_yard(problem, options, seed);
}

/// The yard with its things and targets lifted onto ground of that shape.
GuardProblem lifted(GuardProblem problem, const HeightField& field) {
  problem.world = problem.world.on(std::make_shared<const HeightField>(field));
  for (std::size_t i = 1; i < problem.world.solids.size(); ++i) {
    Vec3& at = problem.world.solids[i].world_T_solid.position;
    at.z += field.height(xy(at));
  }
  for (Target& target : problem.targets) target.base.z += field.height(xy(target.base));
  return problem;
}

TEST(TerrainRun, FlatGroundGivesTheSameBytesAsNone) {
  Rng rng(1);
  const GuardProblem problem = testing::random_guard_problem(rng, 6, 3, 3.0);
  const GuardProblem flat =
      lifted(problem, terrain_of({-4, -4}, {0.5, 0.5}, 17, 17, [](Vec2) { return 0.0; }));
  EXPECT_EQ(test::bytes_of_run(run_of(problem, 3).run), test::bytes_of_run(run_of(flat, 3).run));
}

TEST(TerrainRun, GroundThatIsFlatAndHigherGivesTheSamePlan) {
  Rng rng(2);
  const GuardProblem problem = testing::random_guard_problem(rng, 6, 3, 3.0);
  // Whole and half metres are exact, so nothing is rounded otherwise.
  const GuardProblem high =
      lifted(problem, terrain_of({-4, -4}, {0.5, 0.5}, 17, 17, [](Vec2) { return 2.0; }));
  ASSERT_NE(high.world.terrain, nullptr);
  const YardRun low_run = run_of(problem, 3);
  const YardRun high_run = run_of(high, 3);
  ASSERT_EQ(low_run.plan.stops.size(), high_run.plan.stops.size());
  EXPECT_NEAR(low_run.plan.cost_s, high_run.plan.cost_s, 1e-6);
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    EXPECT_EQ(low_run.firing_map.regions[t].hits, high_run.firing_map.regions[t].hits);
  }
}

TEST(TerrainRun, OnHillsTheBoundHoldsShotsHitAndDrivesAreOnTheSurface) {
  Rng rng(3);
  double reached = 0.0;
  double targets = 0.0;
  for (int i = 0; i < cases(3); ++i) {
    const HeightField field = hill(4.5, 0.5, rng.uniform(0.3, 0.8), 3.0);
    const GuardProblem problem = lifted(testing::random_guard_problem(rng, 4, 3, 3.0), field);
    const YardRun mission = run_of(problem, 1);
    EXPECT_LE(mission.plan.lower_bound_s, mission.plan.bounded_s() + 1e-6);
    for (const PlannedStop& stop : mission.plan.stops) {
      const Stance stance = stance_at(mission.firing_map.rules, stop.position);
      for (const PlannedHit& hit : stop.hits) {
        const Target& target = problem.targets[hit.target];
        const Flight flight = launch(mission.firing_map.rules, {stop.position, {}}, target, hit.shot.shot);
        EXPECT_NEAR(flight.muzzle.z, muzzle(problem.gun, stance, stop.position, hit.shot.gun).z, 1e-9);
        EXPECT_TRUE(fly(flight, problem.gun.ball_radius_m, mission.firing_map.space(hit.target), target,
                        problem.world.floor_z_m)
                        .hit);
        EXPECT_GE(hit.shot.gun.pitch_rad, problem.gun.pitch_low_rad - 1e-9);
        EXPECT_LE(hit.shot.gun.pitch_rad, problem.gun.pitch_high_rad + 1e-9);
      }
      for (std::size_t k = 1; k < stop.waypoints.size(); ++k) {
        const Segment leg{stop.waypoints[k - 1], stop.waypoints[k]};
        for (double part = 0.0; part <= 1.0; part += 0.01) {
          const Vec2 p = leg.a + part * (leg.b - leg.a);
          EXPECT_LE(norm(field.gradient(p)), std::tan(problem.robot.max_slope_rad) + 1e-9);
        }
      }
    }
    // The driven way is as long as the track on the surface.
    double along = 0.0;
    for (const auto& path : testing::driven_paths(mission.run.log)) {
      for (std::size_t k = 1; k < path.size(); ++k) along += field.length({path[k - 1], path[k]});
    }
    EXPECT_NEAR(metric(mission.run, "driven_m"), along, 1e-9);
    reached += metric(mission.run, "reached");
    targets += metric(mission.run, "targets") - metric(mission.run, "unreachable");
    const auto* relief = mission.run.log.latest<outrider_msgs::Terrain>(topic::terrain);
    ASSERT_NE(relief, nullptr);
    EXPECT_FALSE(relief->contours.empty());
    const Vec2 last = vec2_of(relief->origin) +
                      Vec2{(relief->columns - 1) * relief->spacing.x, (relief->rows - 1) * relief->spacing.y};
    EXPECT_NEAR(relief->heights.back(), field.height(last), 1e-9);
  }
  EXPECT_GE(reached, targets - 1.0);
}

/// The place on a leg after some time, by small steps over the surface.
Vec3 own_place(const RobotModel& robot, const HeightField& field, const Segment& leg, double after_s) {
  const double way_m = covered(field.length(leg), robot.straight(), after_s);
  constexpr int steps = 20'000;
  const auto at = [&](int i) {
    const Vec2 p = leg.a + static_cast<double>(i) / steps * (leg.b - leg.a);
    return Vec3{p.x, p.y, field.height(p)};
  };
  double done_m = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double step_m = norm(at(i) - at(i - 1));
    if (done_m + step_m >= way_m) return at(i - 1) + (way_m - done_m) / step_m * (at(i) - at(i - 1));
    done_m += step_m;
  }
  return at(steps);
}

/// Shots from a robot that climbs and leans: each hits with the velocity that the surface gives it, by small
/// steps; the mission takes what the plan says; the bound holds; and it is shorter than from rest.
TEST(TerrainRun, OnHillsShotsInPassingHit) {
  Rng rng(5);
  std::size_t passed = 0, climbing = 0;
  double from_rest_s = 0.0, on_the_move_s = 0.0;
  for (int i = 0; i < cases(4); ++i) {
    const HeightField field = hill(4.5, 0.5, rng.uniform(0.3, 0.8), 3.0);
    GuardProblem problem = lifted(testing::random_guard_problem(rng, 3, 5, 3.0), field);
    problem.errors = {0.0, 0.0, {0.0, 0.0}, 0.0};
    const YardRun mission = run_of(problem, 1, true);
    ASSERT_TRUE(mission.plan.on_the_move);
    EXPECT_LE(mission.plan.lower_bound_s, mission.plan.cost_s + 1e-6);
    EXPECT_NEAR(metric(mission.run, "mission_s"), mission.plan.cost_s, 1e-6);
    EXPECT_EQ(metric(mission.run, "reached"),
              metric(mission.run, "targets") - metric(mission.run, "unreachable"));
    EXPECT_EQ(metric(mission.run, "hits_in_passing"), metric(mission.run, "shots_in_passing"));
    from_rest_s += run_of(problem, 1).plan.cost_s;
    on_the_move_s += mission.plan.cost_s;
    for (const PlannedStop& stop : mission.plan.stops) {
      for (const PassingHit& hit : stop.passing) {
        ++passed;
        const Segment leg{stop.waypoints[hit.leg - 1], stop.waypoints[hit.leg]};
        const Vec3 at = own_place(problem.robot, field, leg, hit.after_s);
        constexpr double moment_s = 1e-3;
        const Vec3 velocity = 1.0 / moment_s *
                              (own_place(problem.robot, field, leg, hit.after_s + 0.5 * moment_s) -
                               own_place(problem.robot, field, leg, hit.after_s - 0.5 * moment_s));
        if (std::abs(velocity.z) > 0.02) ++climbing;
        const Stance stance = stance_at(mission.firing_map.rules, xy(at));
        Flight flight = launch(problem.gun, stance, xy(at), hit.shot.shot, problem.world.gravity_mps2);
        flight.velocity_mps = flight.velocity_mps + velocity;
        EXPECT_TRUE(fly(flight, problem.gun.ball_radius_m, mission.firing_map.space(hit.target),
                        problem.targets[hit.target], problem.world.floor_z_m)
                        .hit);
        EXPECT_GE(hit.shot.gun.pitch_rad, problem.gun.pitch_low_rad - 1e-9);
        EXPECT_LE(hit.shot.gun.pitch_rad, problem.gun.pitch_high_rad + 1e-9);
      }
    }
  }
  EXPECT_GT(passed, 4U);
  EXPECT_GT(climbing, 1U);
  EXPECT_LT(on_the_move_s, 0.9 * from_rest_s);
}

TEST(TerrainSurvey, ALongerWayUphillTakesLonger) {
  GuardProblem problem;
  problem.world.bounds = {{-3, -3}, {3, 3}};
  problem.world.solids = {testing::floor_at(0.0)};
  problem.world = problem.world.on(std::make_shared<const HeightField>(
      terrain_of({-4, -4}, {1, 1}, 9, 9, [](Vec2 p) { return 0.3 * p.x; })));
  const DriveCost cost = drive_cost(problem.robot, 0.0, {{-2, 0}, {2, 0}}, problem.world.terrain.get());
  EXPECT_NEAR(cost.driven_m, 4.0 * std::hypot(1.0, 0.3), 1e-12);
  EXPECT_NEAR(cost.time_s, testing::own_duration(cost.driven_m, 0.8, 0.8), 1e-12);
}

TEST(TerrainSurvey, SaysWhereTheStartIsTooSteep) {
  GuardProblem problem;
  problem.world.bounds = {{-3, -3}, {3, 3}};
  problem.world.solids = {testing::floor_at(0.0)};
  problem.start = {{0.5, 0.25}, 0.0};
  const auto slope = [&](double by) {
    GuardProblem on = problem;
    on.world = on.world.on(std::make_shared<const HeightField>(
        terrain_of({-4, -4}, {1, 1}, 9, 9, [by](Vec2 p) { return by * p.x; })));
    return on;
  };
  EXPECT_TRUE(build_firing_map(slope(0.3), coarse()));
  const auto steep = build_firing_map(slope(1.0), coarse());
  ASSERT_FALSE(steep);
  EXPECT_EQ(steep.error().where, "start");
  EXPECT_EQ(
      steep.error().sentence,
      "the ground under the robot at (0.5, 0.25) is as steep as 45.0 degrees, and it holds on 20; start "
      "elsewhere or raise robot.max_slope");
}

TEST(TerrainSurvey, TargetsBeyondSteepGroundAreOutOfReach) {
  GuardProblem problem;
  problem.world.bounds = {{-9, -3}, {9, 3}};
  problem.world.solids = {testing::floor_at(0.0)};
  problem.start = {{-8, 0}, 0.0};
  problem.gun.muzzle_speed_mps = 5.0;
  const HeightField field =
      terrain_of({-10, -4}, {0.5, 0.5}, 41, 17, [](Vec2 p) { return 1.0 * std::clamp(p.x + 1.0, 0.0, 2.0); });
  problem.world = problem.world.on(std::make_shared<const HeightField>(field));
  problem.targets = {{"near", {-5, 0, 0}, {0.4, 0.4, 0.4}}, {"far", {7, 0, 2}, {0.4, 0.4, 0.4}}};
  const YardRun mission = run_of(problem, 1);
  ASSERT_EQ(mission.plan.unreachable.size(), 1U);
  EXPECT_EQ(mission.plan.unreachable[0].target, 1U);
  EXPECT_EQ(testing::targets_of(mission.run.log)[0].status, "reached");
}

TEST(TerrainSurvey, RefusesTerrainThatEndsWithinTheYard) {
  GuardProblem problem;
  problem.world.bounds = {{-5, -3}, {3, 3}};
  problem.world.solids = {testing::floor_at(0.0)};
  problem.world = problem.world.on(std::make_shared<const HeightField>(hill(4.0, 0.5, 0.5, 3.0)));
  const auto refused = build_firing_map(problem, coarse());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "terrain");
  EXPECT_NE(refused.error().sentence.find("spans (-4, -4) to (4, 4)"), std::string::npos);
}

}  // namespace
}  // namespace outrider
