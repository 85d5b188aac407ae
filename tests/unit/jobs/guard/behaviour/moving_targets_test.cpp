#include "outrider/jobs/guard/run/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/guard/run/robot.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::cases;

GuardOptions walkers_options() {
  GuardOptions options;
  options.resolution_m = 0.25;
  return options;
}

/// A yard with two walls between which foxes walk about.
GuardProblem yard_with_walls(bool with_errors) {
  GuardProblem problem;
  problem.world.name = "yard";
  problem.world.bounds = {{-6, -6}, {6, 6}};
  problem.world.solids = {testing::floor_at(0), testing::box_at("long", {-1.5, 0, 1}, {5, 0.2, 2}),
                          testing::box_at("short", {2.5, 2, 1}, {0.2, 4, 2})};
  problem.start = {{0, -5}, radians(90)};
  const Vec3 size{0.4, 0.3, 0.4};
  problem.targets = {{"pond", {4.5, 4.5, 0}, size, 0.0},
                     {"bench", {-4.5, 4.5, 0}, size, 1.0},
                     {"bin", {-4.5, -3, 0}, size, 2.0},
                     {"gate", {4.5, -3, 0}, size, 0.5},
                     {"tree", {0.5, 3.5, 0}, size, -1.0}};
  if (!with_errors) problem.errors = {0.0, 0.0, {0.0, 0.0}};
  return problem;
}

const std::vector<double> often_at_the_pond = {12.0, 0.3, 0.3, 0.3, 3.0};

/// Returns the observations of earlier intruders: their walks under another seed, every half second.
std::vector<Track> past(const GuardProblem& problem, const FiringMap& firing_map,
                        const WanderOptions& options) {
  const auto walks = draw_walks(problem, firing_map, often_at_the_pond, options, 999, 600.0);
  std::vector<Track> tracks;
  for (const Walk& walk : *walks) {
    Track track;
    for (double t = 0.0; t < 600.0; t += 0.5) track.push_back({t, walk.at(t)});
    tracks.push_back(track);
  }
  return tracks;
}

/// How often each place is visited in the long run, by iterating the chain of visits.
std::vector<double> visits(const std::vector<double>& weights) {
  std::vector<double> share(weights.size(), 1.0 / static_cast<double>(weights.size()));
  for (int round = 0; round < 500; ++round) {
    std::vector<double> next(weights.size(), 0.0);
    for (std::size_t from = 0; from < weights.size(); ++from) {
      double others = 0.0;
      for (std::size_t to = 0; to < weights.size(); ++to) others += to != from ? weights[to] : 0.0;
      for (std::size_t to = 0; to < weights.size(); ++to) {
        if (to != from) next[to] += share[from] * weights[to] / others;
      }
    }
    for (std::size_t i = 0; i < share.size(); ++i) share[i] = 0.5 * (share[i] + next[i]);
  }
  return share;
}

TEST(Wander, WalksOnFreeGroundAtItsSpeedAndLikesWhatItPrefers) {
  const GuardProblem problem = yard_with_walls(true);
  const auto firing_map = build_firing_map(problem, walkers_options());
  WanderOptions options;
  options.speed_mps = 0.7;
  options.rest_s = 5.0;
  const auto walks = draw_walks(problem, *firing_map, often_at_the_pond, options, 3, 20000.0);
  ASSERT_TRUE(walks.has_value()) << walks.error().sentence;
  std::vector<double> rested(problem.targets.size(), 0.0);
  double rests = 0.0, seconds = 0.0;
  for (const Walk& walk : *walks) {
    for (std::size_t i = 1; i < walk.knots.size(); ++i) {
      const auto& a = walk.knots[i - 1];
      const auto& b = walk.knots[i];
      ASSERT_LT(a.time_s, b.time_s);
      const double way = distance(a.position, b.position);
      if (way == 0.0) {
        for (std::size_t t = 0; t < rested.size(); ++t) {
          if (a.position == xy(problem.targets[t].base)) rested[t] += 1.0;
        }
        rests += 1.0;
        seconds += b.time_s - a.time_s;
        continue;
      }
      EXPECT_NEAR(way / (b.time_s - a.time_s), options.speed_mps, 1e-6);
      for (double part = 0.0; part <= 1.0; part += 0.05) {
        ASSERT_GT(firing_map->ground.clearance(a.position + part * (b.position - a.position), 1.0), 0.0099);
      }
    }
  }
  EXPECT_NEAR(seconds / rests, options.rest_s, 0.3);
  const auto often = visits(often_at_the_pond);
  for (std::size_t t = 0; t < rested.size(); ++t) {
    EXPECT_NEAR(rested[t] / rests, often[t], 0.02) << problem.targets[t].name;
  }
}

/// The map finds the pond, and how long they stay, from what was seen.
TEST(VisitMap, LearnsWhereTheyRest) {
  const GuardProblem problem = yard_with_walls(true);
  const auto firing_map = build_firing_map(problem, walkers_options());
  WanderOptions options;
  options.speed_mps = 0.7;
  options.rest_s = 8.0;
  const VisitMap map = visit_map(problem, *firing_map, past(problem, *firing_map, options), options);
  const auto most = std::max_element(map.seconds.begin(), map.seconds.end()) - map.seconds.begin();
  EXPECT_LT(distance(map.regions[static_cast<std::size_t>(most)], Vec2{4.5, 4.5}), 1.0);
  EXPECT_NEAR(map.rest_s / map.rests, 8.0, 2.0);
  EXPECT_NEAR(map.speed_mps, 0.7, 0.07);
  options.learn = false;
  const VisitMap blank = visit_map(problem, *firing_map, past(problem, *firing_map, options), options);
  EXPECT_EQ(*std::max_element(blank.seconds.begin(), blank.seconds.end()), 0.0);
}

TEST(VisitMap, TellsAWalkFromARest) {
  WanderOptions options;
  options.sight_m = 0.0;
  Track track;
  for (double t = 0.0; t < 4.0; t += 0.5) track.push_back({t, {1.0, 2.0}});
  EXPECT_EQ(norm(stride_of(track, options).velocity_mps), 0.0);
  for (double t = 4.0; t < 5.6; t += 0.5)
    track.push_back({t, {1.0 + 0.6 * (t - 3.5), 2.0 - 0.8 * (t - 3.5)}});
  const Stride stride = stride_of(track, options);
  EXPECT_NEAR(stride.velocity_mps.x, 0.6, 1e-12);
  EXPECT_NEAR(stride.velocity_mps.y, -0.8, 1e-12);
  EXPECT_NEAR(straight_on(stride, 20.0).at(9.5).x, 1.0 + 0.6 * 6.0, 1e-9);
}

/// Every shot of a run, flown again in small steps at the true walk; all that was promised; the same
/// twice.
TEST(MovingTargets, HitsEverybodyAndSaysWhatHappened) {
  WanderOptions wander;
  wander.speed_mps = 0.5;
  wander.rest_s = 10.0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(3)); ++seed) {
    const GuardProblem problem = yard_with_walls(true);
    const auto firing_map = build_firing_map(problem, walkers_options());
    const auto history = past(problem, *firing_map, wander);
    const auto walks = draw_walks(problem, *firing_map, often_at_the_pond, wander, seed, 7200.0);
    const auto plan = plan_moving(problem, *firing_map, visit_map(problem, *firing_map, history, wander),
                                  walkers_options(), wander);
    ASSERT_TRUE(plan.has_value()) << plan.error().sentence;
    auto run = testing::run_walkers(*plan, *walks, walkers_options(), seed);
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    test::LogRecorder recorder;
    EXPECT_EQ(test::bytes_of_run(run), test::bytes_of_run(testing::run_walkers(
                                           *plan, *walks, walkers_options(), seed, {.sinks = {&recorder}})));
    EXPECT_EQ(recorder.finish(), test::bytes_of_log(run.log));
    for (const auto& stamped : testing::shots_of(run.log)) {
      const outrider_msgs::Shot& shot = stamped.message;
      const auto who =
          static_cast<std::size_t>(std::find_if(problem.targets.begin(), problem.targets.end(),
                                                [&](const Target& t) { return t.name == shot.target; }) -
                                   problem.targets.begin());
      ASSERT_LT(who, problem.targets.size());
      const Flight flight{testing::vec3_of(shot.muzzle), testing::vec3_of(shot.velocity),
                          problem.world.gravity_mps2};
      const Target there = moved_to(problem.targets[who], (*walks)[who].at(stamped.time_s() + shot.flight));
      const double gap = distance(flight.position(shot.flight), solid_of(there)) - problem.gun.ball_radius_m;
      EXPECT_EQ(gap < 1e-5, shot.hit) << shot.target;
    }
    const auto targets = testing::targets_of(run.log);
    for (std::size_t who = 0; who < problem.targets.size(); ++who) {
      ASSERT_GT(targets[who].moves().size(), 1U);
      for (const auto& move : targets[who].moves()) {
        EXPECT_LT(distance(xy(move.centre), (*walks)[who].at(move.time_s)), 1e-9);
      }
    }
  }
}

/// Two who rest near: the second is shot at before the ball at the first has landed, unless from rest.
TEST(MovingTargets, AreAimedAtWhileABallFliesAtAnother) {
  GuardProblem problem = yard_with_walls(false);
  problem.world.solids.resize(1);
  problem.targets.resize(2);
  problem.targets[0].base = {1.0, -1.5, 0.0};
  problem.targets[1].base = {-1.0, -1.5, 0.0};
  const std::vector<Walk> walks = {{{{0.0, {1.0, -1.5}}}}, {{{0.0, {-1.0, -1.5}}}}};
  WanderOptions wander;
  wander.sight_m = 0.0;
  for (const bool on_the_move : {true, false}) {
    GuardOptions options = walkers_options();
    options.shoot_on_the_move = on_the_move;
    const auto firing_map = build_firing_map(problem, options);
    const auto plan =
        plan_moving(problem, *firing_map, visit_map(problem, *firing_map, {}, wander), options, wander);
    ASSERT_TRUE(plan.has_value());
    const auto run = testing::run_walkers(*plan, walks, options, 1);
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    const auto& shots = testing::shots_of(run.log);
    ASSERT_EQ(shots.size(), 2U);
    EXPECT_EQ(shots[1].time_s() < shots[0].time_s() + shots[0].message.flight, on_the_move);
  }
}

/// Without errors a straight walker is hit by the first shot.
TEST(MovingTargets, HitsAStraightWalkerAtOnceInAWorldWithoutErrors) {
  Rng rng(74);
  int shots = 0;
  for (int i = 0; i < cases(6); ++i) {
    GuardProblem problem = yard_with_walls(false);
    problem.world.solids.resize(1);
    problem.targets.resize(1);
    const auto firing_map = build_firing_map(problem, walkers_options());
    WanderOptions wander;
    wander.speed_mps = 0.4;
    wander.sight_m = 0.0;
    wander.chance = 0.0;
    const Vec2 from{rng.uniform(-3.0, 3.0), -2.0};
    const Vec2 velocity = 0.4 * direction(rng.uniform(0.0, 6.28));
    const std::vector<Walk> walks = {{{{0.0, from}, {60.0, from + 60.0 * velocity}}}};
    const auto plan = plan_moving(problem, *firing_map, visit_map(problem, *firing_map, {}, wander),
                                  walkers_options(), wander);
    ASSERT_TRUE(plan.has_value());
    Log log;
    auto robot = simulated_guard(problem, *firing_map, log, 1, {.walks = walks, .look_s = wander.look_s});
    robot.act(Wait{0.75});  // two looks: the way is known
    GuardMission mission(*plan);
    const auto command = mission.step(robot.sense());
    if (!command || !std::holds_alternative<AimGun>(*command)) continue;
    ++shots;
    robot.act(*command);
    robot.act(*mission.step(robot.sense()));
    EXPECT_TRUE(log.latest<outrider_msgs::Shot>(topic::shots)->hit);
  }
  EXPECT_GT(shots, 0);
}

/// The next look is later than now, however the times of looks are rounded: 43 looks of 0.05 s are less
/// than 2.15 s.
TEST(MovingTargets, WaitsForALaterLook) {
  const GuardProblem problem = yard_with_walls(false);
  const auto firing_map = build_firing_map(problem, walkers_options());
  WanderOptions wander;
  wander.look_s = 0.05;
  const auto plan = plan_moving(problem, *firing_map, visit_map(problem, *firing_map, {}, wander),
                                walkers_options(), wander);
  ASSERT_TRUE(plan.has_value());
  GuardMission mission(*plan);
  Observation seen;
  seen.odometry = problem.start;
  seen.targets.emplace();
  int waits = 0;
  for (int look = 1; look <= 2000; ++look) {
    seen.time_s = look * wander.look_s;
    const auto command = mission.step(seen);
    ASSERT_TRUE(command.has_value());
    const auto* const wait = std::get_if<Wait>(&*command);
    if (wait == nullptr) continue;
    ++waits;
    EXPECT_GT(wait->until_s, seen.time_s);
    EXPECT_LT(wait->until_s, seen.time_s + 1.5 * wander.look_s);
  }
  EXPECT_GT(waits, 1000);
}

/// One who never moves is hit as a still one is: by the best shot from where the robot stands.
TEST(MovingTargets, OfThoseWhoStayIsTheStillYard) {
  GuardProblem problem = yard_with_walls(false);
  problem.world.solids.resize(1);
  problem.targets.resize(1);
  problem.targets[0].base = {1.0, -2.0, 0.0};
  const auto firing_map = build_firing_map(problem, walkers_options());
  WanderOptions wander;
  wander.sight_m = 0.0;
  const std::vector<Walk> walks = {{{{0.0, {1.0, -2.0}}}}};
  const auto plan = plan_moving(problem, *firing_map, visit_map(problem, *firing_map, {}, wander),
                                walkers_options(), wander);
  ASSERT_TRUE(plan.has_value());
  const GuardOptions options = walkers_options();
  const auto run = testing::run_walkers(*plan, walks, options, 1);
  ASSERT_EQ(run.log.messages<outrider_msgs::Shot>(topic::shots).size(), 1U);
  const auto still =
      best_shot(firing_map->rules, firing_map->space(0), problem.targets[0], problem.start.position, 0.0);
  ASSERT_TRUE(still.has_value());
  const Table& targets = table_named(run.report, "targets");
  const TableRow target{targets, targets.rows.at(0)};
  EXPECT_EQ(target.number("speed_mps"), still->shot.speed_mps);
  EXPECT_EQ(target.number("pitch_rad"), still->shot.pitch_rad);
  EXPECT_EQ(target.text("status"), "reached");
}

/// Knowing where they like to be shortens their stay, on average.
TEST(MovingTargets, IsShorterOnAverageWithTheLearnedMap) {
  const GuardProblem problem = yard_with_walls(true);
  const auto firing_map = build_firing_map(problem, walkers_options());
  WanderOptions wander;
  wander.speed_mps = 0.8;
  wander.rest_s = 4.0;
  const auto history = past(problem, *firing_map, wander);
  const auto learned = plan_moving(problem, *firing_map, visit_map(problem, *firing_map, history, wander),
                                   walkers_options(), wander);
  WanderOptions blank = wander;
  blank.learn = false;
  const auto unlearned = plan_moving(problem, *firing_map, visit_map(problem, *firing_map, history, blank),
                                     walkers_options(), blank);
  ASSERT_TRUE(learned && unlearned);
  double with_map = 0.0, without = 0.0, expected = 0.0, hits = 0.0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(40)); ++seed) {
    const auto walks = draw_walks(problem, *firing_map, often_at_the_pond, wander, seed, 7200.0);
    const auto a = testing::run_walkers(*learned, *walks, walkers_options(), seed);
    const auto b = testing::run_walkers(*unlearned, *walks, walkers_options(), seed);
    with_map += metric(a, "intruder_seconds");
    without += metric(b, "intruder_seconds");
    expected += metric(a, "expected_hits");
    hits += metric(a, "reached");
  }
  EXPECT_LT(with_map, without);
  EXPECT_GT(hits, 0.6 * expected);  // the stated chances are of the size of what happens
  EXPECT_LT(hits, 1.6 * expected);
}

TEST(Wander, IsRefusedWhereItCannotBe) {
  GuardProblem problem = yard_with_walls(true);
  const auto firing_map = build_firing_map(problem, walkers_options());
  WanderOptions options;
  options.speed_mps = 1.0;
  problem.targets[1].base.z = 0.5;
  EXPECT_EQ(draw_walks(problem, *firing_map, often_at_the_pond, options, 1, 10.0).error().where,
            "wander.speed");
  problem = yard_with_walls(true);
  problem.targets[1].base = {-1.5, 0.105, 0.0};
  EXPECT_EQ(draw_walks(problem, *firing_map, often_at_the_pond, options, 1, 10.0).error().where,
            "wander.speed");
}

}  // namespace
}  // namespace outrider
