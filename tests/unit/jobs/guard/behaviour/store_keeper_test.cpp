// Missions on finite supplies: planned, executed and measured; and the single steps of the store keeper.
#include "outrider/jobs/guard/behaviour/store_keeper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/jobs/guard/plan/supply_plan.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "plan/plan_clock.hpp"
#include "support/guard_runs.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

/// The levels after each stop of a plan if every shot hits, without the reserve.
std::vector<SupplyLevel> planned_levels(const GuardProblem& problem, const FiringMap& firing_map,
                                        const GuardPlan& plan) {
  std::vector<SupplyLevel> after;
  PlanClock clock(problem, firing_map, plan);
  while (!clock.done()) {
    clock.make_stop();
    after.push_back(clock.level());
  }
  return after;
}

using testing::coarse;
using testing::planned_yard;
using testing::PlannedYard;

/// A yard of 8 x 8 m with six targets; the well and the dock are beside the start.
GuardProblem yard_with_stations(std::uint64_t seed) {
  Rng rng(seed);
  GuardProblem problem = testing::random_guard_problem(rng, 2, 6, 4.0);
  testing::limit_stores(problem, 0.6);
  return problem;
}

/// Plans with supplies; refused where a station stands in an obstacle.
Outcome<PlannedYard> supplied(GuardProblem problem, bool on_the_move = false) {
  PlannedYard yard = planned_yard(std::move(problem), coarse());
  GuardOptions options = coarse();
  options.shoot_on_the_move = on_the_move;
  auto plan = supply_plan(yard.problem, yard.firing_map, std::move(yard.plan), options, {});
  if (!plan) return pass_on(plan);
  yard.plan = std::move(*plan);
  return yard;
}

/// No store below zero or above full, and each level goes up only where the robot fills it.
void expect_sound_levels(const Run& run) {
  const auto* supplies = run.log.latest<outrider_msgs::Supplies>(topic::supplies);
  const auto& levels = run.log.messages<outrider_msgs::StoreLevels>(topic::stores);
  ASSERT_NE(supplies, nullptr);
  ASSERT_FALSE(levels.empty());
  int filled = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const outrider_msgs::StoreLevels& level = levels[i].message;
    EXPECT_GE(level.water, -1e-9);
    EXPECT_GE(level.charge, -1e-6);
    EXPECT_LE(level.water, supplies->tank);
    EXPECT_LE(level.charge, supplies->battery);
    if (i == 0) continue;
    const outrider_msgs::StoreLevels& before = levels[i - 1].message;
    if (level.water > before.water || level.charge > before.charge) ++filled;
  }
  EXPECT_LE(filled, static_cast<int>(metric(run, "fills")));
}

TEST(SupplyRun, WithoutErrorsTakesWhatItsPlanSays) {
  int fills = 0, passing = 0;
  for (int i = 0; i < testing::cases(4); ++i) {
    GuardProblem problem = yard_with_stations(static_cast<std::uint64_t>(i / 2));
    problem.errors = {0.0, 0.0, {0.0, 0.0}, 0.0};
    const bool on_the_move = i % 2 != 0;
    const auto mission = supplied(std::move(problem), on_the_move);
    if (!mission) continue;  // a station stands in an obstacle
    ASSERT_EQ(mission->plan.on_the_move, on_the_move);
    for (const SupplyLevel& level : planned_levels(mission->problem, mission->firing_map, mission->plan))
      EXPECT_TRUE(suffices(mission->problem.supplies, level));
    const auto run = testing::run_still(mission->problem, mission->firing_map, mission->plan, coarse(), 1);
    expect_sound_levels(run);
    EXPECT_NEAR(metric(run, "mission_s"), mission->plan.cost_s, 1e-6) << i;
    EXPECT_EQ(metric(run, "unplanned_fills"), 0.0) << i;
    const auto after = planned_levels(mission->problem, mission->firing_map, mission->plan);
    if (!after.empty()) {
      const auto* last = run.log.latest<outrider_msgs::StoreLevels>(topic::stores);
      const double waited_s = metric(run, "mission_s") - after.back().time_s;  // for the last ball
      EXPECT_NEAR(last->charge, after.back().charge - mission->problem.supplies.charge_of(waited_s, 0.0),
                  1e-6);
      EXPECT_NEAR(last->water, after.back().water, 1e-9);
    }
    fills += static_cast<int>(metric(run, "fills"));
    if (on_the_move) passing += static_cast<int>(metric(run, "hits_in_passing"));
  }
  EXPECT_GT(fills, 0);
  EXPECT_GT(passing, 0);
}

TEST(SupplyRun, WithErrorsNeverRunsDryAndIsTheSameTwice) {
  int missions = 0;
  for (int i = 0; i < testing::cases(4); ++i) {
    const auto mission = supplied(yard_with_stations(static_cast<std::uint64_t>(100 + i / 2)), i % 2 != 0);
    if (!mission) continue;
    ++missions;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      auto run = testing::run_still(mission->problem, mission->firing_map, mission->plan, coarse(), seed);
      expect_sound_levels(run);
      test::LogRecorder recorder;
      EXPECT_EQ(test::bytes_of_run(run),
                test::bytes_of_run(testing::run_still(mission->problem, mission->firing_map, mission->plan,
                                                      coarse(), seed, {.sinks = {&recorder}})));
      EXPECT_EQ(recorder.finish(), test::bytes_of_log(run.log));
    }
  }
  EXPECT_GE(missions, 2);
}

TEST(SupplyRun, SaysWhatTheSuppliesDoNotSufficeFor) {
  GuardProblem problem = yard_with_stations(1);
  problem.supplies.battery_wh = 0.0;
  problem.supplies.stations.clear();
  const auto mission = supplied(problem);
  ASSERT_TRUE(mission) << mission.error().sentence;
  const std::size_t hits = problem.targets.size() - mission->plan.unreachable.size();
  ASSERT_EQ(mission->plan.unsupplied.size(), hits - 2);
  EXPECT_NE(mission->plan.unsupplied[0].reason.find("no station gives water"), std::string::npos);
  const auto run = testing::run_still(mission->problem, mission->firing_map, mission->plan, coarse(), 1);
  EXPECT_EQ(run.report.status, "not_done");
  expect_sound_levels(run);
}

TEST(SupplyPlan, RefusesWhatIsWrong) {
  const auto says = [](GuardProblem problem, const std::string& key, const std::string& words) {
    const auto mission = supplied(std::move(problem));
    ASSERT_FALSE(mission) << words;
    EXPECT_EQ(mission.error().code, FaultCode::bad_input);
    EXPECT_EQ(mission.error().where, key);
    EXPECT_NE(mission.error().sentence.find(words), std::string::npos) << mission.error().sentence;
  };
  GuardProblem problem = yard_with_stations(1);
  problem.supplies.shot_water = 3.0;
  says(problem, "supplies.tank", "too small for any shot");
  problem = yard_with_stations(1);
  problem.supplies.shot_j = 1e5;
  says(problem, "supplies.battery", "too little for any shot");
  problem = yard_with_stations(1);
  problem.supplies.stations[0].position = {50.0, 0.0};
  says(problem, "supplies.stations", "well at (50, 0) is outside the yard");
  problem = yard_with_stations(1);
  problem.supplies.stations[1].position = {3.95, 3.95};
  says(problem, "supplies.stations", "too close to an obstacle");
}

TEST(SupplyPlan, WithoutEndIsThePlanItself) {
  GuardProblem problem = yard_with_stations(2);
  problem.supplies = {};
  const PlannedYard yard = planned_yard(std::move(problem), coarse());
  const auto same = supply_plan(yard.problem, yard.firing_map, yard.plan, {}, {});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->cost_s, yard.plan.cost_s);
  EXPECT_EQ(same->stops.size(), yard.plan.stops.size());
}

/// An open floor with a well and a dock, and the charge that it takes to get about there, by hand.
struct OpenFloor {
  GuardProblem problem;
  std::optional<FiringMap> firing_map;
  std::optional<TaskBoard> board;
  StoreKeeper keeper;

  explicit OpenFloor(Vec2 well = {2.0, -3.5}, Vec2 dock = {-2.0, 0.5}) {
    problem.world.bounds = {{-4, -4}, {4, 4}};
    problem.world.solids = {testing::floor_at(0)};
    problem.start = {{-2, -3.5}, radians(90)};
    problem.targets = {{"fox", {0.5, 3.3, 0}, {0.4, 0.3, 0.4}}, {"cat", {-3, -1, 0}, {0.4, 0.3, 0.4}}};
    problem.supplies.tank = 3.0;
    problem.supplies.battery_wh = 1.0;
    problem.supplies.stations = {{"well", well, true, false}, {"dock", dock, false, true}};
    firing_map = build_firing_map(problem, coarse()).value();
    board.emplace(problem, *firing_map, 2);
    board->do_first({{1.0, 1.0}, {0}});
  }

  [[nodiscard]] double drive_j(Pose2 from, Vec2 to) const {
    const RobotModel& robot = problem.robot;
    const Vec2 way = to - from.position;
    if (norm(way) == 0.0) return 0.0;
    const double turn = testing::own_angle(std::atan2(way.y, way.x) - from.heading_rad);
    const double time_s = testing::own_duration(turn, robot.turn_rate_radps, robot.turn_acceleration_radps2) +
                          testing::own_duration(norm(way), robot.speed_mps, robot.acceleration_mps2);
    return problem.supplies.power_w * time_s + problem.supplies.drive_jpm * norm(way);
  }
  [[nodiscard]] Pose2 after(Pose2 from, Vec2 to) const { return {to, heading_of(to - from.position)}; }
  [[nodiscard]] Vec2 dock() const { return problem.supplies.stations[1].position; }
  [[nodiscard]] double home_j(Pose2 from) const { return drive_j(from, dock()); }
  /// Aim by half a turn, and the longest flight.
  [[nodiscard]] double any_shot_j() const {
    const double aim_s = pi / std::min(problem.gun.yaw_rate_radps, problem.gun.pitch_rate_radps);
    const double flight_s = 2.0 * problem.gun.muzzle_speed_mps / problem.world.gravity_mps2;
    return problem.supplies.power_w * (aim_s + flight_s) + problem.supplies.shot_j;
  }
  [[nodiscard]] Observation with(double water, double charge_j) const {
    Observation seen{.time_s = 10.0, .odometry = problem.start, .gun = GunState{}};
    seen.stores = StoreLevels{water, charge_j};
    return seen;
  }
  std::optional<Store> lacking(Command command, double water, double charge_j) const {
    return StoreKeeper::lacking(command, *board, with(water, charge_j));
  }
  /// The command takes just that charge, and water where it says so.
  void expect_needs(const Command& command, double charge_j, bool water) const {
    EXPECT_EQ(lacking(command, 3.0, charge_j + 1e-6), std::nullopt);
    EXPECT_EQ(lacking(command, 3.0, charge_j - 1e-6), Store::charge);
    EXPECT_EQ(lacking(command, 0.5, 3600.0), water ? std::optional(Store::water) : std::nullopt);
  }
  void provide(Store store, double water, double charge_j) {
    keeper.provide(*board, store, with(water, charge_j));
  }
};

TEST(StoreKeeper, KnowsWhatEachCommandTakes) {
  OpenFloor floor;
  const Pose2 start = floor.problem.start;
  const double home_j = floor.home_j(start);
  EXPECT_GT(home_j, 100.0);
  PlannedShot shot;
  shot.flight_s = 0.8;
  floor.board->aim_at(0, shot, start);
  const double shot_j = 0.8 * floor.problem.supplies.power_w + floor.problem.supplies.shot_j;
  floor.expect_needs(Fire{0, {}}, shot_j + home_j, true);
  floor.expect_needs(AimGun{0.3, 0.2}, floor.any_shot_j() + home_j, true);
  const Vec2 stop{1.0, 1.0};
  const FollowWaypoints drive{{start.position, stop}};
  floor.expect_needs(
      drive, floor.drive_j(start, stop) + floor.any_shot_j() + floor.home_j(floor.after(start, stop)), true);

  // To the well: as far as the charger behind it. To the dock: as far as there.
  const Vec2 well = floor.problem.supplies.stations[0].position;
  floor.board->do_first({well, {}, StationCall{0, Store::water}});
  floor.expect_needs(FollowWaypoints{{start.position, well}},
                     floor.drive_j(start, well) + floor.home_j(floor.after(start, well)), false);
  EXPECT_EQ(floor.lacking(AimGun{0.0, 0.0}, 0.0, 0.0), std::nullopt) << "the gun is stowed at a station";
  floor.board->drop_task();
  floor.board->do_first({floor.dock(), {}, StationCall{1, Store::charge}});
  floor.expect_needs(FollowWaypoints{{start.position, floor.dock()}}, floor.drive_j(start, floor.dock()),
                     false);
  EXPECT_EQ(floor.lacking(Fill{{1, Store::charge}}, 0.0, 0.0), std::nullopt);

  // Without a charger only what the command takes counts; without a battery nothing does.
  OpenFloor no_dock;
  no_dock.problem.supplies.stations.pop_back();
  no_dock.expect_needs(AimGun{0.3, 0.2}, no_dock.any_shot_j(), true);
  no_dock.problem.supplies.battery_wh = 0.0;
  EXPECT_EQ(no_dock.lacking(drive, 3.0, 0.0), std::nullopt);
  EXPECT_EQ(no_dock.lacking(drive, 0.0, 0.0), Store::water);
}

TEST(StoreKeeper, CutsAWaitSoThatTheChargeSufficesToGetToTheCharger) {
  OpenFloor floor;
  const double needed_j = floor.any_shot_j() + floor.home_j(floor.problem.start);
  for (const double until_s : {70.0, std::numeric_limits<double>::infinity()}) {
    Command wait = Wait{until_s};
    const Observation seen = floor.with(0.0, needed_j + 30.0 * floor.problem.supplies.power_w);
    EXPECT_EQ(StoreKeeper::lacking(wait, *floor.board, seen), std::nullopt);
    EXPECT_NEAR(std::get<Wait>(wait).until_s, 10.0 + 30.0, 1e-9);
  }
  Command brief = Wait{12.0};
  EXPECT_EQ(StoreKeeper::lacking(brief, *floor.board, floor.with(0.0, 3600.0)), std::nullopt);
  EXPECT_EQ(std::get<Wait>(brief).until_s, 12.0);
  EXPECT_EQ(floor.lacking(Wait{70.0}, 3.0, needed_j - 1e-6), Store::charge);
  floor.problem.supplies.power_w = 0.0;
  Command free = Wait{1e9};
  EXPECT_EQ(StoreKeeper::lacking(free, *floor.board, floor.with(0.0, 3600.0)), std::nullopt);
  EXPECT_EQ(std::get<Wait>(free).until_s, 1e9);
}

TEST(StoreKeeper, GoesToTheChargerFirstWhenTheWaterIsTooFar) {
  OpenFloor floor;
  const Pose2 start = floor.problem.start;
  const Vec2 well = floor.problem.supplies.stations[0].position;
  const double to_well_j = floor.drive_j(start, well) + floor.home_j(floor.after(start, well));
  floor.provide(Store::water, 0.0, to_well_j + 1e-6);
  ASSERT_EQ(floor.board->queue().size(), 2U);
  EXPECT_EQ(floor.board->queue().front().call, (StationCall{0, Store::water}));
  EXPECT_EQ(floor.board->queue().front().place, well);
  EXPECT_EQ(floor.keeper.detours(), 1);

  OpenFloor flat;
  flat.board->set_tasks(flat.board->queue(), true);
  flat.provide(Store::water, 0.0, to_well_j - 1e-6);
  ASSERT_EQ(flat.board->queue().size(), 2U);
  EXPECT_EQ(flat.board->queue().front().call, (StationCall{1, Store::charge}));
  EXPECT_FALSE(flat.board->arrived());
  EXPECT_TRUE(flat.keeper.stranded().empty());
}

TEST(StoreKeeper, GivesUpWhenNoStationCanBeGotTo) {
  OpenFloor flat;
  const double to_dock_j = flat.home_j(flat.problem.start);
  flat.board->settle(1, TargetStatus::reached, "hit", 1.0);
  flat.provide(Store::charge, 3.0, to_dock_j - 1e-6);
  EXPECT_NE(flat.keeper.stranded().find("the charge does not suffice"), std::string::npos);
  EXPECT_TRUE(flat.board->queue().empty());
  EXPECT_EQ(flat.board->records()[0].status, TargetStatus::failed);
  EXPECT_EQ(flat.board->records()[0].reason, flat.keeper.stranded());
  EXPECT_EQ(flat.board->records()[1].status, TargetStatus::reached);

  OpenFloor dry;
  dry.problem.supplies.stations.erase(dry.problem.supplies.stations.begin());
  dry.provide(Store::water, 0.0, 3600.0);
  EXPECT_NE(dry.keeper.stranded().find("the water does not suffice"), std::string::npos);
}

TEST(StoreKeeper, GivesUpATaskForWhichFullStoresDoNotSuffice) {
  OpenFloor floor;
  floor.provide(Store::charge, 3.0, 3600.0);
  EXPECT_TRUE(floor.keeper.stranded().empty());
  EXPECT_TRUE(floor.board->queue().empty());
  EXPECT_EQ(floor.board->records()[0].status, TargetStatus::failed);
  EXPECT_NE(floor.board->records()[0].reason.find("not even full stores"), std::string::npos);
  EXPECT_EQ(floor.board->records()[1].status, TargetStatus::waiting);

  // Six fills without a shot between them are enough.
  OpenFloor often;
  for (int i = 0; i < 6; ++i) often.keeper.note(Fill{{1, Store::charge}});
  often.provide(Store::charge, 3.0, 1000.0);
  EXPECT_EQ(often.board->records()[0].status, TargetStatus::failed);
  OpenFloor rested;
  for (int i = 0; i < 6; ++i) rested.keeper.note(Fill{{1, Store::charge}});
  rested.keeper.note(Wait{1.0});
  rested.provide(Store::charge, 3.0, 1000.0);
  EXPECT_EQ(rested.board->records()[0].status, TargetStatus::waiting);
}

}  // namespace
}  // namespace outrider
