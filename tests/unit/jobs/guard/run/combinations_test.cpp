// Capabilities together: whole missions on small yards, with every shot flown again and every store counted
// again by code that took no part in the mission (support/guard_replay.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "support/guard_replay.hpp"
#include "support/guard_runs.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"
#include "support/random_terrain.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::coarse;
using testing::expect_everybody_accounted_for;
using testing::expect_sound_stores;
using testing::Ledger;
using testing::limit_stores;
using testing::logged_run;
using testing::LoggedTarget;
using testing::replay_shots;
using testing::Replayed;

/// Returns the box of somebody at the place of a target.
auto boxes_of(const GuardProblem& problem) {
  return [&problem](const LoggedTarget& target, double shot_s, double) {
    return testing::box_in(problem, target, shot_s);  // who was hit goes on only then
  };
}

ArrivalOptions eight_intruders() {
  ArrivalOptions options;
  options.count = 8;
  options.rate_hz = 0.05;
  options.stops = 30;
  options.beam = 20;
  return options;
}

/// Intruders that come by one of two doors, as the options say; they are drawn from the seed.
Outcome<Run> run_arrivals(const GuardProblem& problem, const ArrivalOptions& arrivals, std::uint64_t seed,
                          bool on_the_move = false) {
  GuardScenario scenario;
  scenario.problem = problem;
  scenario.options = coarse();
  scenario.options.shoot_on_the_move = on_the_move;
  scenario.arrivals = arrivals;
  scenario.seed = static_cast<std::int64_t>(seed);
  if (arrivals.any()) {
    const std::vector<Entrance> doors = {{"gate", {-2.4, -2.4}}, {"gap", {2.4, 2.4}}};
    auto intruders = draw_arrivals(problem, doors, arrivals, seed);
    if (!intruders) return pass_on(intruders);
    scenario.intruders = std::move(*intruders);
  }
  const auto guard = prepare_guard(std::move(scenario));
  if (!guard) return pass_on(guard);
  return logged_run({}, [&](Log& log) { return run_guard({**guard}, log); });
}

bool came(const Run& run, const std::string& name) {
  return std::ranges::any_of(events_of(run.log, "enter"), [&](const auto& event) {
    return event.message.msg.starts_with(name + " comes in by ");
  });
}

/// The counts of several missions with limited stores, so that a test shows something.
struct Premises {
  int missions = 0;
  int done = 0;
  int fills = 0;
  int recharges = 0;
  int hits = 0;
  double survived = 0.0;
};

/// Missions on random yards with limited stores.
Premises run_with_limited_stores(const ArrivalOptions& arrivals, std::uint64_t first_yard, int yards) {
  Premises had;
  for (int i = 0; i < yards; ++i) {
    Rng rng(first_yard + static_cast<std::uint64_t>(i));
    GuardProblem problem = testing::random_guard_problem(rng, 3, 4, 3.0);
    limit_stores(problem, 0.5);
    problem.supplies.battery_wh = rng.uniform(0.15, 0.5);
    const auto run = run_arrivals(problem, arrivals, 1 + static_cast<std::uint64_t>(i % 3), i % 2 != 0);
    if (!run) {
      EXPECT_EQ(run.error().where, "supplies.stations") << run.error().sentence;
      continue;  // a station stands in an obstacle
    }
    ++had.missions;
    SCOPED_TRACE(first_yard + static_cast<std::uint64_t>(i));
    expect_everybody_accounted_for(*run, arrivals.any() ? 8 : 4);
    const Replayed told = replay_shots(*run, problem, boxes_of(problem));
    const Ledger ledger = expect_sound_stores(*run, problem);
    EXPECT_GE(ledger.least_water, -1e-9);
    EXPECT_GE(ledger.least_charge_j, -1e-3);
    const auto targets = testing::targets_of(run->log);
    const auto& shots = testing::shots_of(run->log);
    EXPECT_EQ(told.shots, static_cast<int>(shots.size()));
    for (const auto& shot : shots) {
      const auto target = std::ranges::find(targets, shot.message.target, &LoggedTarget::name);
      if (target->comes_in()) {
        EXPECT_GE(shot.time_s(), target->settles_s()) << target->name;
      }
    }
    had.done += run->report.status == "done" ? 1 : 0;
    had.fills += ledger.fills;
    had.recharges += ledger.recharges;
    had.hits += told.hits;
    had.survived += static_cast<double>(events_of(run->log, "survive").size());
  }
  return had;
}

TEST(Combinations, IntrudersKeepComingAndStoresEnd) {
  const Premises had = run_with_limited_stores(eight_intruders(), 300, cases(5));
  EXPECT_GE(had.missions, 2);
  EXPECT_GE(had.fills, 2 * had.missions) << "the stores were no limit";
  EXPECT_GT(had.recharges, 0);
  EXPECT_GT(had.done, 0);
  EXPECT_GT(had.hits, 3 * had.missions);
}

TEST(Combinations, IntrudersSurviveAndStoresEnd) {
  ArrivalOptions arrivals;
  arrivals.leave = 0.5;
  arrivals.stops = 30;
  arrivals.beam = 4;
  const Premises had = run_with_limited_stores(arrivals, 320, cases(5));
  EXPECT_GE(had.missions, 2);
  EXPECT_GE(had.fills, had.missions);
  EXPECT_GT(had.done, 0);
  EXPECT_GT(had.survived, 0.0);
}

TEST(Combinations, IntrudersKeepComingSurviveAndStoresEnd) {
  ArrivalOptions arrivals = eight_intruders();
  arrivals.leave = 0.6;
  const Premises had = run_with_limited_stores(arrivals, 340, cases(5));
  EXPECT_GE(had.missions, 2);
  EXPECT_GE(had.fills, had.missions);
  EXPECT_GT(had.done, 0);
  EXPECT_GT(had.survived, 0.0);
}

TEST(Combinations, IntrudersKeepComingOverHills) {
  Rng rng(360);
  int hits = 0, shots = 0, on_slopes = 0;
  for (int i = 0; i < cases(3); ++i) {
    GuardProblem problem = testing::random_guard_problem(rng, 3, 4, 3.0);
    const HeightField field = testing::hill(4.5, 0.5, rng.uniform(0.3, 0.7), 3.0);
    problem.world = problem.world.on(std::make_shared<const HeightField>(field));
    for (std::size_t s = 1; s < problem.world.solids.size(); ++s) {
      Vec3& at = problem.world.solids[s].world_T_solid.position;
      at.z += field.height(xy(at));
    }
    for (Target& target : problem.targets) target.base.z += field.height(xy(target.base));
    const auto run = run_arrivals(problem, eight_intruders(), 1, i % 2 != 0);
    ASSERT_TRUE(run) << to_string(run.error());
    expect_everybody_accounted_for(*run, 8);
    const Replayed told = replay_shots(*run, problem, boxes_of(problem));
    shots += told.shots;
    hits += told.hits;
    const auto targets = testing::targets_of(run->log);
    for (const auto& [time_ns, shot] : testing::shots_of(run->log)) {
      const auto target = std::ranges::find(targets, shot.target, &LoggedTarget::name);
      on_slopes += std::abs(target->places.back().centre.z - shot.muzzle.z) > 0.3 ? 1 : 0;
    }
    const auto poses = poses_of(run->log);
    double along = 0.0;
    for (std::size_t k = 1; k < poses.size(); ++k) {
      along += field.length({poses[k - 1].position, poses[k].position});
    }
    EXPECT_NEAR(metric(*run, "driven_m"), along, 1e-9);
  }
  EXPECT_GT(hits, 0);
  EXPECT_GT(shots, 8);
  EXPECT_GT(on_slopes, 0);
}

/// Returns the place of a walk, by hand.
Vec2 place_on(const Walk& walk, double time_s) {
  for (std::size_t i = walk.knots.size() - 1; i > 0; --i) {
    const auto& a = walk.knots[i - 1];
    const auto& b = walk.knots[i];
    if (time_s >= b.time_s) return b.position;
    if (time_s < a.time_s) continue;
    return a.position + (time_s - a.time_s) / (b.time_s - a.time_s) * (b.position - a.position);
  }
  return walk.knots.front().position;
}

TEST(Combinations, IntrudersWalkAboutInWind) {
  int hits = 0, walking = 0;
  double by_air_m = 0.0;
  for (int i = 0; i < cases(2); ++i) {
    GuardProblem problem;
    problem.world.bounds = {{-4, -4}, {4, 4}};
    problem.world.solids = {testing::floor_at(0), testing::box_at("wall", {0, 0.5, 0.6}, {3, 0.2, 1.2})};
    problem.start = {{0, -3}, radians(90)};
    const Vec3 size{0.5, 0.4, 0.4};
    problem.targets = {
        {"pond", {2.5, 2.5, 0}, size}, {"bench", {-2.5, 2, 0}, size, 1.0}, {"bin", {-2.5, -2, 0}, size, 2.0}};
    problem.air = {0.02, 1.5, radians(40.0 + 90.0 * i)};
    GuardOptions options = coarse();
    options.pitch_step_rad = radians(7.5);
    const auto firing_map = build_firing_map(problem, options, {}, RegionSearch::none);
    ASSERT_TRUE(firing_map) << to_string(firing_map.error());
    WanderOptions wander;
    wander.speed_mps = 0.5;
    wander.rest_s = 2.0;
    wander.chance = 0.3;
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const auto walks = draw_walks(problem, *firing_map, {1.0, 1.0, 1.0}, wander, seed, 7200.0);
    const auto plan =
        plan_moving(problem, *firing_map, visit_map(problem, *firing_map, {}, wander), options, wander);
    ASSERT_TRUE(walks && plan);
    const auto run = testing::run_walkers(*plan, *walks, options, seed);
    expect_everybody_accounted_for(run, 3);
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    const Replayed told = replay_shots(run, problem, [&](const LoggedTarget& target, double, double time_s) {
      const auto who = static_cast<std::size_t>(
          std::ranges::find(problem.targets, target.name, &Target::name) - problem.targets.begin());
      Target box = problem.targets[who];
      const Vec2 place = place_on((*walks)[who], time_s);
      box.base = {place.x, place.y, 0.0};
      return box;
    });
    hits += told.hits;
    walking += told.moved_while_flying_m > 0.02 ? 1 : 0;
    by_air_m = std::max(by_air_m, told.moved_by_air_m);
  }
  EXPECT_GT(hits, 0);
  EXPECT_GT(walking, 0) << "everybody stood still when shot at";
  EXPECT_GT(by_air_m, 0.1) << "the air did nothing";
}

/// A room of 5 x 4 m with a target in the open and one behind a hedge.
GuardProblem room() {
  const auto box = [](std::string name, Vec2 low, Vec2 high) {
    const Vec2 middle = 0.5 * (low + high), size = high - low;
    return testing::box_at(std::move(name), {middle.x, middle.y, 0.5}, {size.x, size.y, 1.0});
  };
  GuardProblem problem;
  problem.world.name = "room";
  problem.world.solids = {testing::floor_at(0),
                          box("south", {-0.1, -0.1}, {5.1, 0}),
                          box("north", {-0.1, 4}, {5.1, 4.1}),
                          box("west", {-0.1, 0}, {0, 4}),
                          box("east", {5, 0}, {5.1, 4}),
                          box("hedge", {1.5, 2.2}, {3.5, 2.4})};
  problem.world.bounds = {{0, 0}, {5, 4}};
  problem.start = {{1.0, 1.0}, 0.0};
  problem.errors.position_m = 0.02;
  problem.targets = {{"open", {3.0, 0.6, 0.0}, {0.3, 0.3, 0.3}},
                     {"hidden", {2.5, 3.2, 0.0}, {0.3, 0.3, 0.3}},
                     {"corner", {4.4, 3.3, 0.0}, {0.3, 0.3, 0.3}}};
  problem.supplies.tank = 1.0;
  problem.supplies.battery_wh = 3.0;
  problem.supplies.stations = {{"well", {1.0, 2.0}, true, false}, {"dock", {0.7, 1.0}, false, true}};
  return problem;
}

/// Explores the room, plans with stations on the map found, and guards it.
Outcome<Run> explore_and_guard(const GuardProblem& problem, std::uint64_t seed) {
  GuardJob job;
  job.scenario.problem = problem;
  job.scenario.options = coarse();
  job.scenario.scout.unknown = true;
  job.scenario.seed = static_cast<std::int64_t>(seed);
  Run run;
  if (auto ok = job.run(run, {}); !ok) return pass_on(ok);
  return run;
}

TEST(Combinations, TheYardIsUnknownAndStoresEnd) {
  const GuardProblem problem = room();
  int fills = 0, hits = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(2)); ++seed) {
    const auto run = explore_and_guard(problem, seed);
    ASSERT_TRUE(run) << to_string(run.error());
    expect_everybody_accounted_for(*run, problem.targets.size());
    // The track of the exploring has a pose a scan: its chords are a little shorter than the way.
    const Ledger ledger = expect_sound_stores(*run, problem, 60.0);
    hits += replay_shots(*run, problem, boxes_of(problem)).hits;
    fills += ledger.fills;
    EXPECT_EQ(run->report.status, "done") << run->report.reason;
    EXPECT_GE(ledger.least_water, 0.0);
    EXPECT_GE(ledger.least_charge_j, 0.0);
    EXPECT_LT(ledger.least_charge_j, 0.9 * 3600.0 * problem.supplies.battery_wh);
    const double explore_s = metric(*run, "explore_s");
    ASSERT_FALSE(testing::shots_of(run->log).empty());
    EXPECT_GT(testing::shots_of(run->log).front().time_s(), explore_s);
  }
  EXPECT_GE(fills, 2) << "a tank of one shot has to be filled for three targets";
  EXPECT_GE(hits, 3);
}

TEST(Combinations, ABatteryThatIsEmptyBeforeTheYardIsExploredIsSaid) {
  GuardProblem problem = room();
  problem.supplies.battery_wh = 0.1;
  const auto run = explore_and_guard(problem, 1);
  ASSERT_TRUE(run) << to_string(run.error());
  expect_everybody_accounted_for(*run, problem.targets.size());
  EXPECT_EQ(run->report.status, "not_done");
  EXPECT_NE(run->report.reason.find("the battery was empty"), std::string::npos) << run->report.reason;
  EXPECT_LT(testing::count_stores(*run, problem).least_charge_j, 0.0);
  EXPECT_TRUE(testing::shots_of(run->log).empty()) << "it shot with an empty battery";
}

/// A tank that nothing fills: the mission ends while intruders keep coming, and says why.
TEST(Combinations, WithoutAWellTheMissionEndsWhenTheTankIsEmpty) {
  for (const double leave : {1.0, 0.5}) {
    Rng rng(380);
    GuardProblem problem = testing::random_guard_problem(rng, 0, 4, 3.0);
    limit_stores(problem, 0.5);
    problem.supplies.stations.erase(problem.supplies.stations.begin());
    ArrivalOptions arrivals = eight_intruders();
    arrivals.leave = leave;
    const auto run = run_arrivals(problem, arrivals, 1);
    ASSERT_TRUE(run) << to_string(run.error());
    expect_everybody_accounted_for(*run, 8);
    EXPECT_EQ(run->report.status, "not_done");
    EXPECT_EQ(testing::shots_of(run->log).size(), 2U);
    EXPECT_NE(run->report.reason.find("water"), std::string::npos) << run->report.reason;
    EXPECT_LT(metric(*run, "reached"), 3.0);
    const double end_s = testing::track_of(run->log).back().time_s;
    const LoggedTarget last = testing::targets_of(run->log).back();
    EXPECT_GT(last.enters_s(), end_s) << "everybody had come by then";
    EXPECT_FALSE(came(*run, last.name));
    EXPECT_GE(metric(*run, "intruder_seconds"), 0.0);
    for (const auto& event : events_of(run->log))
      EXPECT_LE(event.time_s(), end_s + 1e-9) << event.message.msg;
    replay_shots(*run, problem, boxes_of(problem));
    EXPECT_GE(expect_sound_stores(*run, problem).least_water, 0.0);
  }
}

/// The only charger is farther away than the battery lasts, or there is none.
TEST(Combinations, WithoutAChargerInReachTheMissionEnds) {
  for (const bool far_charger : {true, false}) {
    Rng rng(390);
    GuardProblem problem = testing::random_guard_problem(rng, 0, 4, 3.0);
    limit_stores(problem, 0.5);
    problem.supplies.battery_wh = 0.06;
    problem.supplies.stations.pop_back();
    if (far_charger) problem.supplies.stations.push_back({"dock", {0.0, 2.6}, false, true});
    const auto run = run_arrivals(problem, eight_intruders(), 1);
    ASSERT_TRUE(run) << to_string(run.error());
    expect_everybody_accounted_for(*run, 8);
    EXPECT_EQ(run->report.status, "not_done");
    EXPECT_NE(run->report.reason.find("charge"), std::string::npos) << run->report.reason;
    EXPECT_GE(expect_sound_stores(*run, problem).least_charge_j, -1e-3) << "it drove or shot without charge";
    const LoggedTarget last = testing::targets_of(run->log).back();
    EXPECT_GT(last.enters_s(), testing::track_of(run->log).back().time_s);
    EXPECT_FALSE(came(*run, last.name));
    EXPECT_GE(metric(*run, "intruder_seconds"), 0.0);
  }
}

}  // namespace
}  // namespace outrider
