#include "outrider/jobs/guard/plan/passing.hpp"

#include <gtest/gtest.h>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;
using testing::fly_fine;
using testing::own_angle;
using testing::own_duration;
using testing::OwnGun;
using testing::quick_on_the_move;
using testing::random_guard_problem;

/// A street with targets on both sides, the last of them at its end.
GuardProblem street(Rng& rng, std::size_t targets) {
  GuardProblem problem;
  problem.world.bounds = {{-1, -4}, {14, 4}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, 0}, 0.0};
  for (std::size_t i = 0; i < targets; ++i) {
    const double x = 1.5 + 10.0 * static_cast<double>(i + 1) / static_cast<double>(targets);
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    problem.targets.push_back({fmt::format("cat_{}", i),
                               {x + rng.uniform(-0.5, 0.5), side * rng.uniform(1.5, 3.2), 0.0},
                               {0.5, 0.3, 0.45},
                               rng.uniform(0.0, 3.0)});
    problem.world.solids.push_back(
        box_at(fmt::format("post_{}", i), {x - 1.0, -side * 1.2, 0.5}, {0.3, 0.1, 1.0}));
  }
  return problem;
}

struct PassingCase : testing::PlannedYard {  // from rest
  GuardPlan passing;                         // and from the way
};

PassingCase planned_case(GuardProblem problem) {
  testing::PlannedYard yard = testing::planned_yard(std::move(problem), testing::quick());
  GuardPlan passing = shoot_in_passing(yard.problem, yard.firing_map, yard.plan);
  return {std::move(yard), std::move(passing)};
}

/// Returns the place and speed of a robot that long after it left a place on its way to another, by small
/// steps.
Platform own_platform(const RobotModel& robot, Vec2 from, Vec2 to, double after_s) {
  constexpr int steps = 20000;
  const double total = own_duration(norm(to - from), robot.speed_mps, robot.acceleration_mps2);
  const double t = std::clamp(after_s, 0.0, total);
  const auto speed = [&](double s) {
    return std::min({robot.speed_mps, robot.acceleration_mps2 * s, robot.acceleration_mps2 * (total - s)});
  };
  double way = 0.0;
  for (int i = 0; i < steps; ++i) way += speed((i + 0.5) * t / steps) * t / steps;
  const Vec2 along = 1.0 / norm(to - from) * (to - from);
  return {from + way * along, (after_s == t ? speed(t) : 0.0) * along};
}

/// Flies the ball of a shot from a robot that drives, by small steps.
bool hits_from(const PassingCase& c, const Platform& platform, std::size_t target, const Shot& shot) {
  const OwnGun gun{c.problem.gun};
  const Vec2 yaw{std::cos(shot.yaw_rad), std::sin(shot.yaw_rad)};
  const double level = shot.speed_mps * std::cos(shot.pitch_rad);
  const Vec2 tip = platform.position + gun.ahead(shot.pitch_rad) * yaw;
  const Vec2 v = platform.velocity_mps + level * yaw;
  const Solid solid = solid_of(c.problem.targets[target]);
  return fly_fine({tip.x, tip.y, gun.above(shot.pitch_rad)},
                  {v.x, v.y, shot.speed_mps * std::sin(shot.pitch_rad)}, gun.gravity,
                  c.problem.gun.ball_radius_m, c.firing_map.space(target).solids(), &solid, -1.0, 5e-4)
      .hit;
}

/// A gun that turns while the robot drives, and the balls in the air.
struct OwnMovingGun {
  const GuardProblem& problem;
  double yaw = 0.0;  // against the body
  double pitch = 0.0;
  double free = 0.0;    // since when it may turn
  double landed = 0.0;  // the last ball

  /// Turns for a shot from a body with that heading; when it is ready.
  double ready(const Shot& shot, double heading) {
    const double relative = shot.yaw_rad - heading;
    const double turn_s = std::max(own_angle(relative - yaw) / problem.gun.yaw_rate_radps,
                                   std::abs(shot.pitch_rad - pitch) / problem.gun.pitch_rate_radps);
    yaw = relative;
    pitch = shot.pitch_rad;
    return free + turn_s;
  }
  void fires(double time, double flight_s) {
    free = time;
    landed = std::max(landed, time + flight_s);
  }
};

/// The time of a plan, added up from waypoints and shots; the gun is seen to be in time for each shot.
double own_cost_in_passing(const GuardProblem& problem, const GuardPlan& plan) {
  const RobotModel& robot = problem.robot;
  OwnMovingGun gun{problem};
  double time = 0.0;
  double heading = problem.start.heading_rad;
  for (const PlannedStop& stop : plan.stops) {
    std::size_t shots = 0;
    for (std::size_t i = 1; i < stop.waypoints.size(); ++i) {
      const Vec2 leg = stop.waypoints[i] - stop.waypoints[i - 1];
      if (norm(leg) == 0.0) continue;
      const double next = std::atan2(leg.y, leg.x);
      time += own_duration(own_angle(next - heading), robot.turn_rate_radps, robot.turn_acceleration_radps2);
      heading = next;
      for (const PassingHit& hit : stop.passing) {
        if (hit.leg != i) continue;
        EXPECT_LE(gun.ready(hit.shot.shot, heading), time + hit.after_s);
        gun.fires(time + hit.after_s, hit.shot.flight_s);
        ++shots;
      }
      time += own_duration(norm(leg), robot.speed_mps, robot.acceleration_mps2);
    }
    EXPECT_EQ(shots, stop.passing.size());
    for (const PlannedHit& hit : stop.hits) {
      time = std::max(time, gun.ready(hit.shot.shot, heading));
      gun.fires(time, hit.shot.flight_s);
      if (!hit.shot.survives) gun.free = time = time + hit.shot.flight_s;
    }
  }
  return std::max(time, gun.landed);
}

std::size_t in_passing(const GuardPlan& plan) {
  std::size_t count = 0;
  for (const PlannedStop& stop : plan.stops) count += stop.passing.size();
  return count;
}

TEST(Straights, AddUpToTheDrive) {
  Rng rng(501);
  for (int i = 0; i < cases(200); ++i) {
    RobotModel robot;
    robot.acceleration_mps2 = rng.uniform(0.1, 2.0);
    std::vector<Vec2> way;
    for (int k = 0; k < 4; ++k) way.push_back({rng.uniform(-3, 3), rng.uniform(-3, 3)});
    way.push_back(way.back());
    const auto parts = straights(robot, 0.7, way);
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_NEAR(parts.back().begin_s + parts.back().length_s, drive_cost(robot, 0.7, way).time_s, 1e-9);
    const double t = rng.uniform(-0.2, 1.2) * parts[1].length_s;
    const Platform platform = platform_on(robot, way[1], way[2], t);
    const Platform own = own_platform(robot, way[1], way[2], t);
    EXPECT_LT(distance(platform.position, own.position), 1e-6);
    EXPECT_LT(distance(platform.velocity_mps, own.velocity_mps), 1e-9);
  }
}

TEST(ShootInPassing, KeepsItsPromises) {
  Rng rng(502);
  std::size_t passed = 0;
  for (int i = 0; i < cases(6); ++i) {
    const PassingCase c = planned_case(i % 2 == 0 ? street(rng, 5) : random_guard_problem(rng, 8, 5, 2.5));
    EXPECT_LE(c.passing.cost_s, c.plan.cost_s);
    EXPECT_NEAR(c.passing.cost_s, own_cost_in_passing(c.problem, c.passing), 1e-6);
    EXPECT_LE(c.passing.lower_bound_s, c.passing.cost_s);
    std::vector<int> times(c.problem.targets.size(), 0);
    for (const Unreachable& lost : c.passing.unreachable) ++times[lost.target];
    Vec2 at = c.problem.start.position;
    for (const PlannedStop& stop : c.passing.stops) {
      EXPECT_FALSE(stop.hits.empty());
      EXPECT_EQ(stop.waypoints.front(), at);
      EXPECT_EQ(stop.waypoints.back(), stop.position);
      at = stop.position;
      const double radius_m = c.problem.robot.radius_m;
      EXPECT_GE(c.firing_map.ground.clearance(at, 1.0), radius_m - 1e-9);
      for (std::size_t k = 1; k < stop.waypoints.size(); ++k)
        EXPECT_TRUE(c.firing_map.ground.segment_free({stop.waypoints[k - 1], stop.waypoints[k]}, radius_m));
      for (const PlannedHit& hit : stop.hits) {
        ++times[hit.target];
        EXPECT_TRUE(hits_from(c, {stop.position, {}}, hit.target, hit.shot.shot));
      }
      for (const PassingHit& hit : stop.passing) {
        ++times[hit.target];
        const Platform from =
            own_platform(c.problem.robot, stop.waypoints[hit.leg - 1], stop.waypoints[hit.leg], hit.after_s);
        EXPECT_TRUE(hits_from(c, from, hit.target, hit.shot.shot));
      }
    }
    for (const int count : times) EXPECT_EQ(count, 1);
    passed += in_passing(c.passing);
  }
  EXPECT_GT(passed, 6U);
}

/// The only target is hit from some place on the way to the place of the plan.
TEST(ShootInPassing, MovesAStopToWhereTheDrivesAreShorter) {
  GuardProblem problem;
  problem.world.bounds = {{-1, -4}, {14, 4}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, 0}, 0.0};
  problem.gun.muzzle_speed_mps = 4.0;
  problem.targets = {{"cat", {6, 0, 0}, {0.5, 0.3, 0.45}, 0.0}};
  const auto firing_map = build_firing_map(problem, testing::quick());
  ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  auto plan = plan_guard(problem, *firing_map, testing::quick(), {});
  ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
  ASSERT_EQ(plan->stops.size(), 1U);
  // As if the plan had driven aside before it shoots.
  PlannedStop& stop = plan->stops[0];
  const Vec2 aside = stop.position + Vec2{0.0, 0.6};
  const auto shot = best_shot(firing_map->rules, firing_map->space(0), problem.targets[0], aside,
                              stop.hits[0].shot.gun.pitch_rad);
  ASSERT_TRUE(shot.has_value());
  stop = {aside, {problem.start.position, aside}, {{0, *shot}}};
  const double before = own_cost_in_passing(problem, *plan);
  const GuardPlan moved = shoot_in_passing(problem, *firing_map, *plan);
  EXPECT_LT(moved.cost_s, before - 0.5);
  EXPECT_NEAR(moved.cost_s, own_cost_in_passing(problem, moved), 1e-6);
}

TEST(ShootInPassing, ShortensAStreet) {
  Rng rng(503);
  const PassingCase c = planned_case(street(rng, 6));
  EXPECT_LT(c.passing.cost_s, 0.9 * c.plan.cost_s);
  EXPECT_GE(in_passing(c.passing), 2U);
}

TEST(PassingShot, HitsUnderErrorsWithinTheBounds) {
  Rng rng(504);
  const PassingCase c = planned_case(street(rng, 6));
  const ExecutionErrors& errors = c.problem.errors;
  int flown = 0;
  int hits = 0;
  for (const PlannedStop& stop : c.passing.stops) {
    for (const PassingHit& hit : stop.passing) {
      const bool last = hit.leg + 1 == stop.waypoints.size();
      for (int k = 0; k < cases(100); ++k) {
        const double off = errors.position_m * std::sqrt(rng.uniform());
        const Vec2 end = stop.waypoints[hit.leg] + (last ? off : 0.0) * direction(rng.uniform(0.0, 6.3));
        const Platform from = platform_on(c.problem.robot, stop.waypoints[hit.leg - 1], end,
                                          hit.after_s + errors.timing_s * rng.uniform(-1.0, 1.0));
        Shot shot = hit.shot.shot;
        shot.yaw_rad += errors.aim.gun_rad * rng.uniform(-1.0, 1.0);
        shot.pitch_rad += errors.aim.gun_rad * rng.uniform(-1.0, 1.0);
        shot.speed_mps *= 1.0 + errors.aim.speed_ratio * rng.uniform(-1.0, 1.0);
        ++flown;
        hits += hits_from(c, from, hit.target, shot) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(flown, 100);
  EXPECT_GE(hits, 0.99 * flown);
}

/// Each shot in passing, flown in air by small steps of Heun's method.
TEST(PassingShot, HitsInWind) {
  Rng rng(505);
  GuardProblem problem = street(rng, 4);
  problem.air = {0.03, 3.0, 1.0};
  const PassingCase c = planned_case(problem);
  EXPECT_GE(in_passing(c.passing), 1U);
  const Vec3 wind{3.0 * std::cos(1.0), 3.0 * std::sin(1.0), 0.0};
  const auto law = [&](Vec3 v) { return Vec3{0, 0, -9.8} - 0.03 * norm(v - wind) * (v - wind); };
  for (const PlannedStop& stop : c.passing.stops) {
    for (const PassingHit& hit : stop.passing) {
      const Platform from =
          own_platform(c.problem.robot, stop.waypoints[hit.leg - 1], stop.waypoints[hit.leg], hit.after_s);
      const Shot& shot = hit.shot.shot;
      const OwnGun gun{c.problem.gun};
      const Vec2 yaw = direction(shot.yaw_rad);
      const Vec2 tip = from.position + gun.ahead(shot.pitch_rad) * yaw;
      const Vec2 level = from.velocity_mps + shot.speed_mps * std::cos(shot.pitch_rad) * yaw;
      Vec3 p{tip.x, tip.y, gun.above(shot.pitch_rad)};
      Vec3 v{level.x, level.y, shot.speed_mps * std::sin(shot.pitch_rad)};
      constexpr double dt = 1e-4;
      const Solid target = solid_of(c.problem.targets[hit.target]);
      double time = 0.0;
      for (; p.z > 0.0 && testing::own_distance(p, target) > gun.gun.ball_radius_m; time += dt) {
        const Vec3 a = law(v);
        const Vec3 later = v + dt * a;
        p = p + 0.5 * dt * (v + later);
        v = v + 0.5 * dt * (a + law(later));
      }
      EXPECT_GT(p.z, 0.0);
      EXPECT_NEAR(time, hit.shot.flight_s, 1e-3);
    }
  }
}

TEST(PlanGuard, OnTheMoveIsBoundedAndCostsWhatItsPartsAddUpTo) {
  Rng rng(506);
  for (int i = 0; i < cases(4); ++i) {
    const GuardProblem problem = street(rng, 6);
    GuardOptions options = quick_on_the_move();
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const auto plan = plan_guard(problem, *firing_map, options, {});
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    EXPECT_TRUE(plan->on_the_move);
    EXPECT_NEAR(plan->cost_s, own_cost_in_passing(problem, *plan), 1e-6);
    EXPECT_GT(plan->anywhere_lower_bound_s, 0.0);
    EXPECT_LE(plan->anywhere_lower_bound_s, plan->cost_s);
    options.prove = true;
    const auto proven = plan_guard(problem, *firing_map, options, {});
    ASSERT_TRUE(proven.has_value()) << proven.error().sentence;
    EXPECT_FALSE(proven->on_the_move) << "tours are proven for shots from rest";
    EXPECT_TRUE(proven->tour_proven);
    EXPECT_LT(plan->cost_s, proven->cost_s);
  }
}

}  // namespace
}  // namespace outrider
