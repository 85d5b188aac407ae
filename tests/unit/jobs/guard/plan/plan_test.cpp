#include "outrider/jobs/guard/plan/plan.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "outrider/jobs/guard/plan/bound.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;
using testing::own_cost;
using testing::OwnGun;
using testing::random_guard_problem;

/// Every promise of a plan, by other means than those of the planner.
void expect_sound(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                  const GuardOptions& options) {
  std::vector<int> times(problem.targets.size(), 0);
  for (const Unreachable& lost : plan.unreachable) {
    ++times[lost.target];
    EXPECT_FALSE(lost.reason.empty());
    EXPECT_EQ(firing_map.regions[lost.target].hits, 0U);
  }
  Vec2 at = problem.start.position;
  for (const PlannedStop& stop : plan.stops) {
    ASSERT_FALSE(stop.waypoints.empty());
    EXPECT_LT(distance(stop.waypoints.front(), at), 1e-9);
    EXPECT_LT(distance(stop.waypoints.back(), stop.position), 1e-9);
    at = stop.position;
    for (std::size_t i = 1; i < stop.waypoints.size(); ++i) {
      const Segment leg{stop.waypoints[i - 1], stop.waypoints[i]};
      EXPECT_TRUE(firing_map.ground.segment_free(leg, problem.robot.radius_m));
      for (int k = 0; k <= 100; ++k) {
        EXPECT_GE(firing_map.ground.clearance(leg.a + k / 100.0 * (leg.b - leg.a), 1.0),
                  problem.robot.radius_m - 2e-9);
      }
    }
    EXPECT_FALSE(stop.hits.empty());
    for (const PlannedHit& hit : stop.hits) {
      ++times[hit.target];
      const Solid target = solid_of(problem.targets[hit.target]);
      const auto end = OwnGun{problem.gun}.shoot(stop.position, hit.shot.shot,
                                                 firing_map.space(hit.target).solids(), &target, -1.0);
      EXPECT_TRUE(end.hit) << problem.targets[hit.target].name;
      EXPECT_NEAR(end.time_s, hit.shot.flight_s, 2e-4);
      EXPECT_GE(end.gap_m, options.margin_m - 3e-4);
    }
  }
  for (const int count : times) EXPECT_EQ(count, 1);
  EXPECT_NEAR(plan.cost_s, own_cost(problem, plan), 1e-6);
  EXPECT_LE(plan.lower_bound_s, plan.bounded_s() + 1e-9);
  EXPECT_GE(plan.bounded_s(), plan.cost_s - 1e-6);
  if (plan.stops.empty()) return;
  std::vector<std::size_t> hit;
  for (std::size_t t = 0; t < firing_map.regions.size(); ++t) {
    if (firing_map.regions[t].hits > 0) hit.push_back(t);
  }
  EXPECT_DOUBLE_EQ(plan.anywhere_lower_bound_s, mission_bound(problem, firing_map, hit, options, {}));
  EXPECT_GE(plan.lower_bound_s, std::min(plan.cost_s, plan.anywhere_lower_bound_s));
}

TEST(PlanGuard, KeepsItsPromisesInRandomYards) {
  Rng rng(81);
  std::size_t hit = 0;
  std::size_t lost = 0;
  for (int i = 0; i < cases(12); ++i) {
    auto problem = random_guard_problem(rng, 12, 1 + static_cast<std::size_t>(i) % 6, 2.5);
    problem.targets_block = i % 3 == 0;
    if (i % 4 == 1) problem.targets[0].base.z = 7.0;
    GuardOptions options = testing::from_rest();
    options.resolution_m = 0.15;
    options.stops = 60;
    options.iterations = 300;
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const auto plan = plan_guard(problem, *firing_map, options, {});
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    expect_sound(problem, *firing_map, *plan, options);
    lost += plan->unreachable.size();
    hit += problem.targets.size() - plan->unreachable.size();

    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto site_again = build_firing_map(problem, options);
    const auto again = plan_guard(problem, *site_again, options, {});
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(plan->cost_s, again->cost_s);
    EXPECT_EQ(plan->lower_bound_s, again->lower_bound_s);
    ASSERT_EQ(plan->stops.size(), again->stops.size());
    for (std::size_t s = 0; s < plan->stops.size(); ++s) {
      EXPECT_EQ(plan->stops[s].waypoints, again->stops[s].waypoints);
      ASSERT_EQ(plan->stops[s].hits.size(), again->stops[s].hits.size());
      for (std::size_t k = 0; k < plan->stops[s].hits.size(); ++k) {
        EXPECT_EQ(plan->stops[s].hits[k].target, again->stops[s].hits[k].target);
        EXPECT_EQ(plan->stops[s].hits[k].shot.shot.pitch_rad, again->stops[s].hits[k].shot.shot.pitch_rad);
      }
    }
  }
  EXPECT_GT(hit, 25U);
  EXPECT_GT(lost, 0U);
}

GuardProblem hut_problem() {
  GuardProblem problem;
  problem.world.bounds = {{-3, -3}, {3, 3}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, -2.5}, radians(90)};
  problem.targets = {{"free", {-1.5, 0, 0}, {0.5, 0.2, 0.4}, 0.0},
                     {"shut", {1.5, 0.5, 0}, {0.3, 0.2, 0.3}, 0.0}};
  for (const double d : {-0.5, 0.5}) {
    problem.world.solids.push_back(
        box_at(d < 0 ? "hut/west" : "hut/east", {1.5 + d, 0.5, 0.5}, {0.05, 1.0, 1.0}));
    problem.world.solids.push_back(
        box_at(d < 0 ? "hut/south" : "hut/north", {1.5, 0.5 + d, 0.5}, {1.0, 0.05, 1.0}));
  }
  problem.world.solids.push_back(box_at("hut/roof", {1.5, 0.5, 1.0}, {1.1, 1.1, 0.05}));
  return problem;
}

TEST(PlanGuard, NamesWhatStandsInTheWayOfAnUnreachableTarget) {
  const GuardProblem problem = hut_problem();
  const GuardOptions options{.resolution_m = 0.2, .shoot_on_the_move = false};
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = plan_guard(problem, *firing_map, options, {});
  ASSERT_TRUE(plan.has_value());
  expect_sound(problem, *firing_map, *plan, options);
  ASSERT_EQ(plan->unreachable.size(), 1U);
  EXPECT_EQ(plan->unreachable[0].target, 1U);
  const std::string& reason = plan->unreachable[0].reason;
  EXPECT_NE(reason.find("hut/"), std::string::npos) << reason;
  EXPECT_NE(reason.find("places every 0.2 m, pitches every 2.5 degrees, aim points every 0.05 m"),
            std::string::npos)
      << reason;
  EXPECT_EQ(reason.find("cannot be driven to"), std::string::npos) << reason;
  const auto& blocked = firing_map->no_shots[1].blocked;
  ASSERT_TRUE(blocked);
  const std::string& wall = firing_map->space(1).solids()[blocked->solid].name;
  EXPECT_EQ(wall.find("hut/"), 0U) << wall;
  EXPECT_NE(reason.find("; the best flight, from ("), std::string::npos) << reason;
  EXPECT_NE(reason.find("touches " + wall), std::string::npos) << reason;
}

TEST(PlanGuard, SaysWhenATargetIsOutOfReachOrOnlyHitFromElsewhere) {
  GuardProblem problem = hut_problem();
  problem.targets[1].base.z = 8.0;
  const GuardOptions options{.resolution_m = 0.2, .shoot_on_the_move = false};
  const auto firing_map = build_firing_map(problem, options);
  const auto plan = plan_guard(problem, *firing_map, options, {});
  ASSERT_EQ(plan->unreachable.size(), 1U);
  EXPECT_NE(plan->unreachable[0].reason.find("within reach"), std::string::npos)
      << plan->unreachable[0].reason;

  // A roofed hut with room for the robot: from inside the cat could be hit.
  problem = hut_problem();
  problem.world.solids = {floor_at(0)};
  for (const double d : {-1.2, 1.2}) {
    problem.world.solids.push_back(box_at("wall", {1.5 + d, 0.5, 0.5}, {0.05, 2.4, 1.0}));
    problem.world.solids.push_back(box_at("wall", {1.5, 0.5 + d, 0.5}, {2.4, 0.05, 1.0}));
  }
  problem.world.solids.push_back(box_at("roof", {1.5, 0.5, 1.0}, {2.5, 2.5, 0.05}));
  const auto hall = build_firing_map(problem, options);
  ASSERT_TRUE(hall.has_value());
  EXPECT_TRUE(hall->no_shots[1].from_elsewhere);
  const auto outside = plan_guard(problem, *hall, options, {});
  ASSERT_EQ(outside->unreachable.size(), 1U);
  EXPECT_NE(outside->unreachable[0].reason.find("cannot be driven to"), std::string::npos);
}

TEST(PlanGuard, TellsOfFasterAndFasterToursAndPlansTheSame) {
  Rng rng(5);
  const GuardProblem problem = random_guard_problem(rng, 12, 6, 2.5);
  GuardOptions options = testing::from_rest();
  options.resolution_m = 0.15;
  options.stops = 60;
  options.iterations = 300;
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map);
  std::vector<TourDraft> told;
  const auto watched =
      plan_guard(problem, *firing_map, options, {}, [&](const TourDraft& draft) { told.push_back(draft); });
  const auto alone = plan_guard(problem, *firing_map, options, {});
  ASSERT_TRUE(watched && alone);
  EXPECT_EQ(watched->cost_s, alone->cost_s);
  EXPECT_EQ(watched->stops.size(), alone->stops.size());
  ASSERT_FALSE(told.empty());
  for (std::size_t i = 0; i < told.size(); ++i) {
    std::size_t served = 0;
    for (const DraftStop& stop : told[i].stops) served += stop.targets.size();
    EXPECT_EQ(served + alone->unreachable.size(), problem.targets.size());
    EXPECT_EQ(told[i].way.front(), problem.start.position);
    EXPECT_EQ(told[i].way.back(), told[i].stops.back().position);
    if (i > 0) {
      EXPECT_LE(told[i].cost_s, 0.99 * told[i - 1].cost_s);
    }
  }
  EXPECT_GE(told.back().cost_s, alone->bounded_s() - 1e-9);
  EXPECT_EQ(draft_of(problem, *alone).stops.size(), alone->stops.size());
}

TEST(PlanGuard, IsEmptyWithoutTargets) {
  GuardProblem problem = hut_problem();
  problem.targets.clear();
  const auto firing_map = build_firing_map(problem, {});
  ASSERT_TRUE(firing_map.has_value());
  const auto plan = plan_guard(problem, *firing_map, testing::from_rest(), {});
  ASSERT_TRUE(plan.has_value());
  EXPECT_TRUE(plan->stops.empty());
  EXPECT_EQ(plan->cost_s, 0.0);
  EXPECT_GT(plan->places, 100U);
}

TEST(PlanGuard, PassesABudgetThatEndsAtOnceOn) {
  const GuardProblem problem = hut_problem();
  const auto firing_map = build_firing_map(problem, {});
  Budget budget;
  budget.expansions = 0;
  const auto plan = plan_guard(problem, *firing_map, testing::from_rest(), budget);
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, FaultCode::budget_exhausted);
}

/// A target that the lattice of exhaust() alone finds still gets a shot that flies.
TEST(PlanGuard, ShootsThroughASlitThatTheCentreDoesNotSee) {
  GuardProblem problem = hut_problem();
  problem.targets = {{"wide", {0, 1.5, 0}, {1.6, 0.2, 0.4}, 0.0}};
  problem.world.solids = {floor_at(0),
                          box_at("north", {0, 2.4, 1.5}, {6, 0.05, 3}),
                          box_at("left", {-1.57, 1.0, 1.5}, {1.95, 0.05, 3.0}),
                          box_at("right", {1.15, 1.0, 1.5}, {3.2, 0.05, 3.0}),
                          box_at("lintel", {0, 1.0, 2.0}, {6, 0.05, 2.0}),
                          box_at("west", {-1.2, 1.7, 1.5}, {0.05, 1.4, 3.0}),
                          box_at("east", {1.2, 1.7, 1.5}, {0.05, 1.4, 3.0})};
  GuardOptions options = testing::from_rest();
  options.resolution_m = 0.3;
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  const auto plan = plan_guard(problem, *firing_map, options, {});
  ASSERT_TRUE(plan.has_value());
  EXPECT_TRUE(plan->unreachable.empty());
  expect_sound(problem, *firing_map, *plan, options);
}

// ---- Routes -------------------------------------------------------------------------------------

/// Pairs of posts with gaps a little wider than the robot: the corners around them lose some of the
/// passages, the cells do not.
TEST(SiteRoutes, ConnectWhateverTheCellsConnect) {
  Rng rng(83);
  int restored = 0;
  for (int i = 0; i < cases(12); ++i) {
    GuardProblem problem;
    problem.world.bounds = {{-2.5, -2.5}, {2.5, 2.5}};
    problem.world.solids = {floor_at(0)};
    problem.start = {{-1.0, -2.1}, 0.0};
    // A fence of posts from west to east with gaps of 0.55 m, not quite straight.
    Vec2 post{-2.5, 0.0};
    double radius = 0.6;
    while (post.x < 3.5) {
      problem.world.solids.push_back({"post", {{post.x, post.y, 0.5}, {}}, CylinderShape{radius, 0.5}});
      const double next = rng.uniform(0.4, 0.9);
      const double bearing = post.y > 0.0 ? rng.uniform(-0.4, 0.0) : rng.uniform(0.0, 0.4);
      post = post + (radius + 0.55 + next) * direction(bearing);
      radius = next;
    }
    const GuardOptions options{.resolution_m = 0.02};
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    std::vector<Vec2> stops{problem.start.position};
    for (int k = 0; k < 12; ++k) {
      const auto cell = rng.below(firing_map->frame.size());
      if (firing_map->reachable[cell] != 0)
        stops.push_back(firing_map->frame.centre(firing_map->frame.cell(cell)));
    }
    const auto plain = routes_between(firing_map->ground, problem.robot, stops, {}, {}, {});
    const auto routes = yard_routes(problem, *firing_map, stops, {});
    ASSERT_TRUE(plain.has_value());
    ASSERT_TRUE(routes.has_value());
    for (std::size_t a = 0; a < stops.size(); ++a) {
      for (std::size_t b = 0; b < stops.size(); ++b) {
        ASSERT_TRUE(std::isfinite(routes->between(a, b).time_s)) << i << ": " << a << " to " << b;
        restored += std::isfinite(plain->between(a, b).time_s) ? 0 : 1;
        const auto way = routes->waypoints(a, b);
        for (std::size_t k = 1; k < way.size(); ++k) {
          EXPECT_TRUE(firing_map->ground.segment_free({way[k - 1], way[k]}, problem.robot.radius_m));
        }
      }
    }
  }
  EXPECT_GT(restored, 0) << "no passage was lost in the first place";
}

}  // namespace
}  // namespace outrider
