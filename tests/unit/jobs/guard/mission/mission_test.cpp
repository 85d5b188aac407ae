// Single steps of a guard mission, with observations that are written by hand: no simulator.
#include "outrider/jobs/guard/mission/mission.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "support/planned_yard.hpp"

namespace outrider {
namespace {

using testing::arrivals_yard;
using testing::ArrivalsYard;
using testing::coarse;
using testing::corners;
using testing::planned_yard;

/// A fox and a cat, each at its place.
ArrivalYard two_come(const ArrivalsYard& yard) {
  return arrival_yard(yard.problem, yard.firing_map,
                      {{"fox", 0, "gate", {}, 0.0, 0.0}, {"cat", 1, "gate", {}, 3.0, 3.0}});
}

Observation seen_at(double time_s, Pose2 pose, std::vector<TargetArrival> arrivals, bool more_to_come) {
  Observation seen{.time_s = time_s, .odometry = pose, .gun = GunState{}};
  seen.targets = TargetReport{std::move(arrivals), {}, more_to_come};
  return seen;
}

TEST(MissionStep, AnArrivalDuringADriveIsPlannedForWherePoliciesInterrupt) {
  const ArrivalsYard yard = arrivals_yard(planned_yard(corners(), coarse()));
  const ArrivalYard arriving = two_come(yard);
  for (const ReplanPolicy& policy : replan_policies()) {
    const RollingPlan plan{arriving, yard.precomputed, policy};
    GuardMission mission(plan);
    const auto first = mission.step(seen_at(0.0, yard.problem.start, {{0, 0.0, 0}}, true));
    ASSERT_TRUE(first && std::holds_alternative<FollowWaypoints>(*first)) << policy.name;
    const auto& way = std::get<FollowWaypoints>(*first);
    EXPECT_EQ(way.until_arrival, policy.interrupts) << policy.name;
    ASSERT_GT(way.waypoints.size(), 2U);
    EXPECT_EQ(mission.arriving()->plans(), 1);
    // The drive ends at its first waypoint, or at its goal.
    const Vec2 here = policy.interrupts ? way.waypoints[1] : way.waypoints.back();
    const auto next = mission.step(seen_at(4.0, {here, 0.0}, {{1, 3.0, 1}}, false));
    ASSERT_TRUE(next.has_value());
    EXPECT_EQ(mission.arriving()->inside().size(), 2U);
    if (policy.interrupts) {
      EXPECT_EQ(mission.arriving()->plans(), 2) << policy.name;
      const auto* follow = std::get_if<FollowWaypoints>(&*next);
      if (follow != nullptr) {
        EXPECT_EQ(follow->waypoints.front(), here);
      }
    } else {
      EXPECT_EQ(mission.arriving()->plans(), 1) << policy.name;
      EXPECT_TRUE(std::holds_alternative<AimGun>(*next)) << policy.name << " dropped what it was at";
    }
  }
}

/// Out of reach is what the firing map proves. Stops that happen to have no shot at a place prove nothing.
TEST(MissionStep, APlaceWithoutAShotIsOutOfReachOnlyWhereThatIsProven) {
  ArrivalsYard yard = arrivals_yard(planned_yard(corners(), coarse()));
  yard.precomputed.reachable[0] = 0;
  for (const bool proven : {false, true}) {
    if (proven) yard.firing_map.regions[0].hits = 0;
    const ArrivalYard arriving = two_come(yard);
    const RollingPlan plan{arriving, yard.precomputed, replan_policies().front()};
    GuardMission mission(plan);
    (void)mission.step(seen_at(0.0, yard.problem.start, {{0, 0.0, 0}}, true));
    EXPECT_EQ(mission.board().records()[0].status, proven ? TargetStatus::unreachable : TargetStatus::failed);
  }
}

TEST(MissionStep, WhoSurvivesAHitIsShotAtWhereItGoes) {
  GuardProblem problem = corners();
  problem.world.solids.resize(1);
  const ArrivalsYard yard = arrivals_yard(planned_yard(std::move(problem), coarse()));
  const auto arriving = arrival_yard(yard.problem, yard.firing_map, {{"fox", 0, {}, {}, 0.0, 0.0}});
  const RollingPlan plan{arriving, yard.precomputed, *find_replan_policy("each_arrival")};
  GuardMission mission(plan);
  Pose2 pose = yard.problem.start;
  double now_s = 0.0;
  std::vector<TargetArrival> arrivals = {{0, 0.0, 0}};
  // Run until a shot. The next observation holds its result.
  const auto until_shot = [&](std::vector<ShotResult> shots) {
    for (int i = 0; i < 20; ++i) {
      Observation seen = seen_at(now_s, pose, std::exchange(arrivals, {}), false);
      seen.shots = std::exchange(shots, {});
      const auto command = mission.step(seen);
      if (!command) return false;
      now_s += 1.0;
      if (const auto* follow = std::get_if<FollowWaypoints>(&*command))
        pose.position = follow->waypoints.back();
      if (const auto* wait = std::get_if<Wait>(&*command)) now_s = wait->until_s;
      if (std::holds_alternative<Fire>(*command)) return true;
    }
    return false;
  };
  ASSERT_TRUE(until_shot({}));
  const double settles_s = now_s + 7.0;
  arrivals = {{0, settles_s, 1}};  // it goes to the place of the cat
  ASSERT_TRUE(until_shot({{0, true, now_s}}));
  EXPECT_EQ(mission.arriving()->survived(), 1);
  EXPECT_EQ(mission.board().target_of(0), arriving.at_place(1));
  EXPECT_GE(now_s, settles_s) << "it was shot at on its way";
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::waiting);
  EXPECT_EQ(mission.board().records()[0].shots, 2);
  const Vec2 cat = xy(yard.problem.targets[1].base);
  EXPECT_NEAR(wrap_angle(mission.board().records()[0].shot->shot.yaw_rad - heading_of(cat - pose.position)),
              0.0, 0.3);
  EXPECT_FALSE(until_shot({{0, true, now_s}}));
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[0].shots, 2);
}

TEST(MissionStep, AVisitToAStationIsNotDroppedWhenSomebodyEnters) {
  GuardProblem problem = corners();
  problem.supplies.tank = 1.0;
  problem.supplies.stations = {{"well", {3.0, -2.5}, true, false}};
  const ArrivalsYard yard = arrivals_yard(planned_yard(std::move(problem), coarse()));
  const ArrivalYard arriving = two_come(yard);
  const RollingPlan plan{arriving, yard.precomputed, *find_replan_policy("each_arrival")};
  GuardMission mission(plan);
  const auto empty_at = [&](double time_s, Vec2 place, std::vector<TargetArrival> arrivals) {
    Observation seen = seen_at(time_s, {place, 0.0}, std::move(arrivals), false);
    seen.stores = StoreLevels{.water = 0.0};
    return seen;
  };
  const Vec2 well = yard.problem.supplies.stations[0].position;
  const auto drive = mission.step(empty_at(0.0, yard.problem.start.position, {{0, 0.0, 0}}));
  ASSERT_TRUE(drive && std::holds_alternative<FollowWaypoints>(*drive));
  EXPECT_EQ(std::get<FollowWaypoints>(*drive).waypoints.back(), well);
  EXPECT_EQ(mission.stores().detours(), 1);
  // On its way there the cat enters, which could be shot at at once if there were water.
  const Vec2 halfway = 0.5 * (yard.problem.start.position + well);
  const auto on = mission.step(empty_at(3.0, halfway, {{1, 3.0, 1}}));
  ASSERT_TRUE(on && std::holds_alternative<FollowWaypoints>(*on));
  EXPECT_EQ(std::get<FollowWaypoints>(*on).waypoints.front(), halfway);
  EXPECT_EQ(std::get<FollowWaypoints>(*on).waypoints.back(), well);
  const auto stow = mission.step(empty_at(6.0, well, {}));
  ASSERT_TRUE(stow && std::holds_alternative<AimGun>(*stow));
  const auto fill = mission.step(empty_at(7.0, well, {}));
  ASSERT_TRUE(fill && std::holds_alternative<Fill>(*fill));
  EXPECT_EQ(std::get<Fill>(*fill).call, (StationCall{0, Store::water}));
  Observation full = empty_at(17.0, well, {});
  full.stores->water = 1.0;
  const auto next = mission.step(full);
  ASSERT_TRUE(next.has_value());
  EXPECT_FALSE(std::holds_alternative<Fill>(*next));
  EXPECT_EQ(mission.stores().detours(), 1);
}

/// A fox and a cat that walk about on an open floor; sight is exact.
struct Walkers {
  GuardProblem problem;
  std::optional<FiringMap> firing_map;
  std::optional<MovingPlan> plan;

  explicit Walkers(double patience_s = 300.0) {
    problem = corners();
    problem.world.solids.resize(1);
    firing_map = build_firing_map(problem, coarse()).value();
    WanderOptions wander;
    wander.speed_mps = 0.4;
    wander.sight_m = 0.0;
    wander.patience_s = patience_s;
    plan.emplace(
        plan_moving(problem, *firing_map, visit_map(problem, *firing_map, {}, wander), coarse(), wander)
            .value());
  }

  /// The fox has been at a place for a second; nothing is seen of the cat.
  [[nodiscard]] Observation fox_at(Vec2 place, double time_s) const {
    Observation seen = seen_at(time_s, problem.start, {}, false);
    for (double t = time_s - 1.0; t <= time_s; t += 0.5) seen.targets->seen.push_back({0, t, place});
    return seen;
  }
};

TEST(MissionStep, AnAimedGunIsFiredWhateverIsSeenMeanwhile) {
  const Walkers yard;
  GuardMission mission(*yard.plan);
  const auto aim = mission.step(yard.fox_at({-2.0, 0.0}, 1.0));
  ASSERT_TRUE(aim && std::holds_alternative<AimGun>(*aim));
  const auto fire = mission.step(yard.fox_at({3.0, 3.0}, 2.0));
  ASSERT_TRUE(fire && std::holds_alternative<Fire>(*fire));
  EXPECT_EQ(std::get<Fire>(*fire).target, 0U);
  EXPECT_EQ(std::get<Fire>(*fire).shot.yaw_rad, std::get<AimGun>(*aim).yaw_rad);
  EXPECT_EQ(std::get<Fire>(*fire).shot.pitch_rad, std::get<AimGun>(*aim).pitch_rad);
  EXPECT_EQ(mission.board().records()[0].shots, 1);
}

TEST(MissionStep, AMissAtAWalkerChangesNothingButTheTime) {
  const Walkers yard;
  for (const bool heard : {true, false}) {
    GuardMission mission(*yard.plan);
    const auto first = mission.step(yard.fox_at({-2.0, 0.0}, 1.0));
    mission.step(yard.fox_at({-2.0, 0.0}, 2.0));
    Observation missed = yard.fox_at({-2.0, 0.0}, 3.0);
    if (heard) missed.shots = {{0, false, 2.9}};
    const auto again = mission.step(missed);
    ASSERT_TRUE(again && std::holds_alternative<AimGun>(*again)) << "it is aimed at anew";
    EXPECT_NEAR(std::get<AimGun>(*again).yaw_rad, std::get<AimGun>(*first).yaw_rad, 0.05);
    EXPECT_EQ(mission.board().records()[0].status, TargetStatus::waiting);
    EXPECT_EQ(mission.board().records()[0].shots, 1);
    EXPECT_EQ(mission.board().records()[0].tries, 0);
  }
}

TEST(MissionStep, WithoutAHitForLongTheRestIsGivenUp) {
  const Walkers yard(20.0);
  GuardMission mission(*yard.plan);
  mission.step(yard.fox_at({-2.0, 0.0}, 1.0));
  mission.step(yard.fox_at({-2.0, 0.0}, 2.0));
  Observation hit = yard.fox_at({-2.0, 0.0}, 3.0);
  hit.shots = {{0, true, 2.9}};
  EXPECT_TRUE(mission.step(hit).has_value());
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[0].done_s, 2.9);
  EXPECT_TRUE(mission.step(seen_at(22.8, yard.problem.start, {}, false)).has_value());
  EXPECT_FALSE(mission.step(seen_at(23.0, yard.problem.start, {}, false)).has_value());
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[1].status, TargetStatus::failed);
  EXPECT_NE(mission.board().records()[1].reason.find("nobody was hit for 20 s"), std::string::npos);
}

}  // namespace
}  // namespace outrider
