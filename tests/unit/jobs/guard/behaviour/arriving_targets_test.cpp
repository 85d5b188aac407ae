#include "outrider/jobs/guard/run/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "outrider/jobs/guard/run/robot.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::arrivals_yard;
using testing::ArrivalsYard;
using testing::cases;
using testing::planned_yard;
using testing::quick;
using testing::random_arrivals_yard;

ArrivalYard crowd(const ArrivalsYard& yard, std::int64_t count, double rate_hz, std::uint64_t seed) {
  ArrivalOptions options;
  options.count = count;
  options.rate_hz = rate_hz;
  const std::vector<Entrance> doors = {{"gate", {-2.4, -2.4}}, {"gap", {2.4, 2.4}}};
  return arrival_yard(yard.problem, yard.firing_map, *draw_arrivals(yard.problem, doors, options, seed));
}

/// Nobody is lost, nobody is shot at before it is there, and nobody does better than the bound.
void expect_laws(const ArrivalYard& watch, const StopTable& precomputed, const ReplanPolicy& policy,
                 const Run& run) {
  const auto targets = testing::targets_of(run.log);
  double failed = 0.0;
  for (std::size_t i = 0; i < watch.intruders.size(); ++i) {
    const testing::LoggedTarget& target = targets.at(i);
    EXPECT_EQ(target.name, watch.intruders[i].name);
    EXPECT_TRUE(target.status != "waiting" && target.status != "outside") << target.status;
    EXPECT_FALSE(target.reason.empty());
    const bool can_be_hit = precomputed.reachable[watch.intruders[i].place] != 0;
    failed += target.status == "failed" ? 1.0 : 0.0;
    if (!can_be_hit) continue;
    EXPECT_NE(target.status, "unreachable");
    EXPECT_GE(nanoseconds(target.done_s), nanoseconds(watch.intruders[i].settles_s));
  }
  EXPECT_EQ(metric(run, "failed"), failed);
  EXPECT_EQ(run.report.status == "done", failed == 0.0);
  for (const auto& shot : testing::shots_of(run.log)) {
    const auto one = std::ranges::find(watch.intruders, shot.message.target, &Intruder::name);
    ASSERT_NE(one, watch.intruders.end());
    EXPECT_GE(shot.time_ns, nanoseconds(one->settles_s));
  }
  const Table& table = table_named(run.report, "targets");
  double counted = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    counted += TableRow{table, table.rows[i]}.number("shots");
  EXPECT_EQ(counted, metric(run, "shots")) << "shots that were not fired are counted, or the reverse";
  EXPECT_GE(metric(run, "intruder_seconds"), metric(run, "intruder_seconds_bound")) << policy.name;
  EXPECT_GE(metric(run, "makespan_s"), metric(run, "makespan_bound_s")) << policy.name;
}

TEST(ArrivingTargets, LosesNobodyStaysAboveTheBoundAndRepeats) {
  Rng rng(51);
  for (int y = 0; y < cases(4); ++y) {
    const ArrivalsYard yard = random_arrivals_yard(rng, 8, 5, true, y % 2 != 0);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const ArrivalYard watch = crowd(yard, 8, 0.02 * static_cast<double>(1 + 4 * seed), seed);
      for (const ReplanPolicy& policy : replan_policies()) {
        const auto objective = seed % 2 == 0 ? ArrivalObjective::makespan : ArrivalObjective::time_inside;
        const RollingPlan plan{watch, yard.precomputed, policy, objective, 3, 50};
        auto run = testing::run_arrivals(plan, quick(), seed);
        expect_laws(watch, yard.precomputed, policy, run);
        EXPECT_GT(metric(run, "makespan_bound_s"), 0.0);
        test::LogRecorder recorder;
        EXPECT_EQ(test::bytes_of_run(run),
                  test::bytes_of_run(testing::run_arrivals(plan, quick(), seed, {}, {.sinks = {&recorder}})));
        EXPECT_EQ(recorder.finish(), test::bytes_of_log(run.log));
        for (const Pose2& pose : poses_of(run.log)) {
          ASSERT_GE(yard.firing_map.ground.clearance(pose.position, 1.0), yard.problem.robot.radius_m - 2e-9);
        }
      }
    }
  }
}

/// The same intruders, from rest and on the move.
TEST(ArrivingTargets, OnTheMoveStayForLessTime) {
  std::array<double, 2> inside_s{};
  for (const bool on_the_move : {false, true}) {
    Rng rng(56);
    for (int y = 0; y < 3; ++y) {
      const ArrivalsYard yard = random_arrivals_yard(rng, 8, 5, true, on_the_move);
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const ArrivalYard watch = crowd(yard, 12, 0.5, seed);
        const RollingPlan plan{watch, yard.precomputed, *find_replan_policy("each_arrival")};
        inside_s[on_the_move ? 1 : 0] +=
            metric(testing::run_arrivals(plan, quick(), seed), "intruder_seconds");
      }
    }
  }
  EXPECT_LT(inside_s[1], inside_s[0]);
}

ArrivalsYard yard_with_corners() { return arrivals_yard(planned_yard(testing::corners(), quick())); }

/// Once the gun is aimed the shot follows, and a drive ends at a waypoint, whoever enters meanwhile.
TEST(ArrivingTargets, FinishesWhatIsInHand) {
  const ArrivalsYard yard = yard_with_corners();
  int shortened = 0;
  for (double enters = 0.1; enters < 20.0; enters += 0.7) {
    const std::vector<Intruder> two = {{"fox", 0, "gate", {}, 0.0, 0.0},
                                       {"cat", 1, "gate", {}, enters, enters}};
    const auto watch = arrival_yard(yard.problem, yard.firing_map, two);
    const auto policy = find_replan_policy("each_arrival");
    const RollingPlan plan{watch, yard.precomputed, *policy};
    Log log;
    auto robot = simulated_guard(watch.problem, watch.firing_map, log, 1, {.intruders = watch.intruders});
    GuardMission mission(plan);
    bool aimed = false;
    while (const auto command = mission.step(robot.sense())) {
      EXPECT_FALSE(aimed && !std::holds_alternative<Fire>(*command)) << "an aimed shot was dropped";
      aimed = std::holds_alternative<AimGun>(*command);
      robot.act(*command);
      const auto* follow = std::get_if<FollowWaypoints>(&*command);
      if (follow == nullptr) continue;
      const auto& way = follow->waypoints;
      const Vec2 here = robot.pose().position;
      if (distance(here, way.back()) <= yard.problem.errors.position_m) continue;
      ++shortened;
      EXPECT_NE(std::find(way.begin() + 1, way.end() - 1, here), way.end() - 1);
    }
    EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
    EXPECT_EQ(mission.board().records()[1].status, TargetStatus::reached);
    EXPECT_EQ(mission.board().cut().all, 0) << "nothing held the robot up";
  }
  EXPECT_GT(shortened, 0) << "no drive was ever cut short: the test shows nothing";
}

/// The messages of one channel, encoded, with their times.
template <class Message>
std::string bytes_of_channel(const Log& log, std::string_view topic) {
  std::string bytes;
  for (const auto& [time_ns, message] : log.messages<Message>(topic)) {
    bytes += std::to_string(time_ns) + ' ' + encode(MessageEncoding::cdr, message) + '\n';
  }
  return bytes;
}

/// The robot does and hits the same, at the same times; nobody has to come in.
void expect_same_mission(const Run& a, const Run& b) {
  const auto expect_same = [&]<class Message>(const Message&, std::string_view topic) {
    const std::string bytes = bytes_of_channel<Message>(a.log, topic);
    EXPECT_FALSE(bytes.empty() && topic != topic::shots && topic != topic::plan) << topic;
    EXPECT_EQ(bytes, bytes_of_channel<Message>(b.log, topic)) << topic;
  };
  expect_same(outrider_msgs::RunInfo{}, topic::run);
  expect_same(outrider_msgs::Solids{}, topic::solids);
  expect_same(geometry_msgs::PoseStamped{}, topic::pose);
  expect_same(tf2_msgs::TFMessage{}, topic::transforms);
  expect_same(sensor_msgs::JointState{}, topic::joints);
  expect_same(nav_msgs::Path{}, topic::plan);
  expect_same(outrider_msgs::Shot{}, topic::shots);
  const auto what_happened = [](const Log& log) {
    std::vector<std::tuple<std::int64_t, std::string, std::string>> events;
    for (const auto& [time_ns, event] : events_of(log)) {
      if (event.name != "enter") events.emplace_back(time_ns, event.name, event.msg);
    }
    return events;
  };
  EXPECT_EQ(what_happened(a.log), what_happened(b.log));
  const auto ends = [](const Log& log) {
    std::vector<std::tuple<std::string, std::string, double, std::uint32_t, double>> all;
    for (const auto& t : testing::targets_of(log)) {
      all.emplace_back(t.name, t.status, t.done_s, t.shots, t.yaw);
      EXPECT_EQ(t.moves().size(), 1U) << t.name;
    }
    return all;
  };
  EXPECT_EQ(ends(a.log), ends(b.log));
  EXPECT_EQ(a.report.status, b.report.status);
}

/// When all are there from the start and the makespan counts, it is the still yard, to the last byte.
TEST(ArrivingTargets, OfThoseWhoAreThereFromTheStartIsTheStillYard) {
  Rng rng(53);
  for (int y = 0; y < cases(5); ++y) {
    const ArrivalsYard yard = random_arrivals_yard(rng, 8, 5, y % 2 == 0);
    const auto still = testing::run_still(yard.problem, yard.firing_map, yard.plan, quick(), 1);
    std::vector<Intruder> all;
    for (std::size_t t = 0; t < yard.problem.targets.size(); ++t)
      all.push_back({"", t, "gate", {}, 0.0, 0.0});
    put_in_order(yard.problem, all);
    const auto watch = arrival_yard(yard.problem, yard.firing_map, all);
    for (const ReplanPolicy& policy : replan_policies()) {
      const RollingPlan plan{watch, yard.precomputed, policy, ArrivalObjective::makespan, 3, 50};
      const auto run = testing::run_arrivals(plan, quick(), 1);
      expect_laws(watch, yard.precomputed, policy, run);
      EXPECT_EQ(metric(run, "unreachable"), metric(still, "unreachable"));
      if (policy.name == "groups") continue;
      EXPECT_EQ(metric(run, "mission_s"), metric(still, "mission_s")) << policy.name;
      EXPECT_EQ(metric(run, "plans"), metric(still, "targets") > metric(still, "unreachable") ? 1.0 : 0.0);
      SCOPED_TRACE(std::string(policy.name));
      expect_same_mission(run, still);
    }
  }
}

/// A drive was to shoot later, and ended at a waypoint because the cat came in.
TEST(ArrivingTargets, ShotsOfADriveThatEndedBeforeAreNotFired) {
  const ArrivalsYard yard = yard_with_corners();
  const std::vector<Intruder> two = {{"fox", 0, "gate", {}, 0.0, 0.0}, {"cat", 1, "gate", {}, 2.0, 2.0}};
  const auto watch = arrival_yard(yard.problem, yard.firing_map, two);
  const RollingPlan plan{watch, yard.precomputed, *find_replan_policy("each_arrival")};
  for (const double leaves_s : {1.5, 4.0}) {
    ArrivingTargets targets(plan);
    TaskBoard board = targets.board();
    Observation seen{0.0, {{-2.0, -1.0}, 0.0}};
    seen.targets = TargetReport{{{0, 0.0, 0}}, {}, true};
    targets.note(board, seen);
    board.set_tasks({{{2.0, 3.0}, {0}}}, true);
    board.launch({0, leaves_s + 1.0, true, leaves_s});
    seen.time_s = 2.0;
    seen.targets = TargetReport{{{1, 2.0, 1}}, {}, false};
    targets.note(board, seen);
    EXPECT_FALSE(board.arrived());
    EXPECT_EQ(board.is_in_air(0), leaves_s <= seen.time_s);
    EXPECT_EQ(board.records()[0].shots, leaves_s > seen.time_s ? 0 : 1);
  }
}

TEST(ArrivingTargets, OfNobodyIsOverAtOnce) {
  Rng rng(54);
  const ArrivalsYard yard = random_arrivals_yard(rng, 8, 5, true);
  const auto watch = arrival_yard(yard.problem, yard.firing_map, {});
  const auto run = testing::run_arrivals({watch, yard.precomputed, replan_policies().front()}, quick(), 1);
  EXPECT_EQ(run.report.status, "done");
  EXPECT_EQ(metric(run, "mission_s"), 0.0);
  EXPECT_TRUE(testing::shots_of(run.log).empty());
}

/// Looking up from the plan helps, on average, by time inside.
TEST(ArrivingTargets, IsShorterOnAverageForThoseWhoPlanAnew) {
  Rng rng(55);
  const ArrivalsYard yard = random_arrivals_yard(rng, 8, 5, true);
  std::map<std::string, double> sums;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ArrivalYard watch = crowd(yard, 12, 0.2, seed);
    for (const ReplanPolicy& policy : replan_policies()) {
      const auto run = testing::run_arrivals(
          {watch, yard.precomputed, policy, ArrivalObjective::time_inside, 2, 50}, quick(), seed);
      sums[std::string(policy.name)] += metric(run, "intruder_seconds");
    }
  }
  EXPECT_LE(sums["each_arrival"], sums["groups"]);
}

}  // namespace
}  // namespace outrider
