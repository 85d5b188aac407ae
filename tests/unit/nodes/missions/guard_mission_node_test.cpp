// The yard is guarded with robot and gun behind topics.
#include "outrider/nodes/missions/guard_mission_node.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/nodes/sim/guard_sim_node.hpp"
#include "support/node_bus.hpp"
#include "support/published.hpp"

namespace outrider {
namespace {

using testing::NodeBus;
using testing::Published;

/// The bundled yard, or what is left of it with the first targets alone.
GuardScenario yard(std::size_t targets = 100) {
  GuardJob job;
  const auto read = read_scenario(job, OUTRIDER_SOURCE_DIR "/scenarios/yard/yard.yaml");
  EXPECT_TRUE(read) << to_string(read.error());
  const auto loaded = job.load();
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  auto& all = job.scenario.problem.targets;
  all.resize(std::min(all.size(), targets));
  job.scenario.options.resolution_m = 0.25;
  job.scenario.options.refinements = 0;
  return job.scenario;
}

class Guarded {
 public:
  explicit Guarded(const GuardScenario& given, const MessageFaults& faults = {})
      : bus(faults), scenario(given) {
    bus.talk();
    RobotSimOptions sim;
    sim.seed = static_cast<std::uint64_t>(scenario.seed);
    bus.start(std::make_unique<GuardSimNode>(GuardSimYard::make(scenario).value(), sim));
    auto guard = GuardMissionNode::prepare(scenario, {});
    EXPECT_TRUE(guard) << to_string(guard.error());
    bus.start(std::make_unique<GuardMissionNode>(GuardMissionNodeOptions(), std::move(*guard)));
  }

  [[nodiscard]] const GuardMissionNode& node() const { return bus.node<GuardMissionNode>("guard"); }
  [[nodiscard]] const GuardSimNode& sim() const { return bus.node<GuardSimNode>("sim"); }
  [[nodiscard]] std::int64_t contacts() const { return sim().robot().body<TwistBody>().contacts(); }
  bool run(double until_s = 1500.0) {
    return bus.run(until_s, [this] { return node().is_over(); });
  }
  /// Each target that the mission calls reached was hit.
  void expect_true() const {
    const auto& records = node().mission().board().records();
    for (std::size_t i = 0; i < records.size(); ++i) {
      if (records[i].status == TargetStatus::reached) {
        EXPECT_TRUE(sim().gone()[i]) << i;
      }
    }
    EXPECT_EQ(contacts(), 0);
  }

  NodeBus bus;
  GuardScenario scenario;
};

TEST(GuardBehindTopics, HitsEveryTargetOfTheYardWithoutContact) {
  Guarded guarded(yard());
  Published published(guarded.bus);
  ASSERT_TRUE(guarded.run()) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "done") << guarded.node().status().sentence;
  EXPECT_EQ(guarded.scenario.problem.targets.size(), 24U);
  EXPECT_EQ(guarded.sim().hits(), 23U);  // one stands where no robot can hit it
  guarded.expect_true();
  published.expect_same<outrider_msgs::Target>(guarded.node().log(), topic::targets);
  published.expect_same<geometry_msgs::PoseStamped>(guarded.node().log(), topic::pose);
  EXPECT_GT(published.count("/joint_states"), 1000U);  // of the robot alone
}

TEST(GuardBehindTopics, LosesMessagesAndHitsEveryTargetAllTheSame) {
  Guarded guarded(yard(8), {.loss = 0.02, .delay_s = 0.1});
  ASSERT_TRUE(guarded.run()) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "done") << guarded.node().status().sentence;
  EXPECT_EQ(guarded.sim().hits(), 7U);  // of 8, one stands where no robot can hit it
  guarded.expect_true();
}

TEST(GuardBehindTopics, DoesTheSameEachTime) {
  Guarded one(yard(3), {.loss = 0.05, .delay_s = 0.05}), other(yard(3), {.loss = 0.05, .delay_s = 0.05});
  ASSERT_TRUE(one.run());
  ASSERT_TRUE(other.run());
  EXPECT_EQ(one.bus.time_s(), other.bus.time_s());
  EXPECT_EQ(one.sim().robot().pose(), other.sim().robot().pose());
  EXPECT_EQ(one.node().status().sentence, other.node().status().sentence);
}

TEST(GuardBehindTopics, AGunOfWhichNothingComesIsGivenUp) {
  GuardScenario jammed = yard(6);
  jammed.faults.gun.jammed_at_s = 0.0;
  Guarded guarded(jammed);
  ASSERT_TRUE(guarded.run()) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "not_done");
  EXPECT_NE(guarded.node().status().sentence.find("0 of 6 targets are told to be hit"), std::string::npos)
      << guarded.node().status().sentence;
  EXPECT_NE(guarded.node().status().sentence.find("the gun gives no result"), std::string::npos)
      << guarded.node().status().sentence;
  EXPECT_EQ(guarded.sim().hits(), 0U);
  EXPECT_LT(guarded.bus.time_s(), 300.0);
}

/// Nobody tells of hits: what is not told is not claimed.
TEST(GuardBehindTopics, HitsThatNobodyTellsAreNotClaimed) {
  Guarded guarded(yard(4));
  guarded.bus.drop = [](const std::string& topic) { return topic == "/gun/hit"; };
  ASSERT_TRUE(guarded.run()) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "not_done");
  EXPECT_GT(guarded.sim().hits(), 0U);
}

TEST(GuardBehindTopics, AGunThatDoesNotTurnEndsTheMission) {
  Guarded guarded(yard(2));
  guarded.bus.drop = [](const std::string& topic) { return topic == "/gun/command"; };
  ASSERT_TRUE(guarded.run()) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "gun_stuck") << guarded.node().status().sentence;
  EXPECT_EQ(guarded.sim().shots(), 0);
}

TEST(GuardBehindTopics, ARobotThatDoesNotMoveIsStuck) {
  Guarded guarded(yard(2));
  guarded.bus.drop = [](const std::string& topic) { return topic == "/cmd_vel"; };
  ASSERT_TRUE(guarded.run(100.0)) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "stuck") << guarded.node().status().sentence;
}

TEST(GuardBehindTopics, StandsWhileItDoesNotKnowWhereItIsOrHowTheGunStands) {
  for (const char* topic : {"/odom", "/joint_states"}) {
    Guarded guarded(yard(2));
    guarded.bus.run(4.0);
    ASSERT_EQ(guarded.node().status().state, "guarding") << guarded.node().status().sentence;
    guarded.bus.drop = [topic](const std::string& sent) { return sent == topic; };
    guarded.bus.run(6.0);
    EXPECT_EQ(guarded.node().status().state, "stopped") << topic;
    EXPECT_EQ(guarded.sim().robot().body<TwistBody>().twist(), Twist2{}) << topic;
    const int shots = guarded.sim().shots();
    guarded.bus.run(12.0);
    EXPECT_EQ(guarded.sim().shots(), shots) << topic;
    guarded.bus.drop = {};
    ASSERT_TRUE(guarded.run()) << topic;
    EXPECT_EQ(guarded.node().status().state, "done") << guarded.node().status().sentence;
    guarded.expect_true();
  }
}

TEST(GuardBehindTopics, ARobotElsewhereThanTheStartIsToldSo) {
  const GuardScenario there = yard(1);
  GuardScenario elsewhere = there;
  elsewhere.problem.start.position.x += 1.0;
  NodeBus bus;
  bus.start(std::make_unique<GuardSimNode>(GuardSimYard::make(elsewhere).value(), RobotSimOptions()));
  bus.start(std::make_unique<GuardMissionNode>(GuardMissionNodeOptions(),
                                               std::move(*GuardMissionNode::prepare(there, {}))));
  bus.run(2.0);
  EXPECT_TRUE(bus.node<GuardMissionNode>("guard").is_over());
  EXPECT_NE(bus.status("guard").sentence.find("the robot stands 1.00 m from the start"), std::string::npos)
      << bus.status("guard").sentence;
}

/// Sends the scans of a range finder on the robot, of a box alone.
class BoxScanner final : public Node {
 public:
  BoxScanner(const SimulatedRobot& robot, Vec2 box) : Node("scanner", 0.1), robot_(robot) {
    world_.solids.push_back({"box", {{box.x, box.y, 0.5}, {}}, BoxShape{{half_m, half_m, 0.5}}});
    scan_output_ = add_output<sensor_msgs::LaserScan>("scan", Delivery::sensor);
    mount_output_ = add_output<tf2_msgs::TFMessage>("/tf_static", Delivery::latched);
  }
  static constexpr double half_m = 0.1;

 private:
  void act() override {
    const RangeFinder finder(footprints_above_floor(world_), RangeFinderModel());
    send(mount_output_, tf2_msgs::TFMessage{{transform_of(now_s(), Pose2{}, "base_link", "laser")}});
    send(scan_output_, scan_message(finder.look(robot_.pose(), now_s(), rng_), now_s()));
  }

  const SimulatedRobot& robot_;
  World world_;
  Rng rng_{3};
  std::size_t scan_output_, mount_output_;
};

TEST(GuardBehindTopics, StopsForWhatTheScanShows) {
  Guarded guarded(yard());
  const auto& queue = guarded.node().mission().board().queue();
  Vec2 from = guarded.scenario.problem.start.position, to = from;
  for (auto task = queue.begin(); task != queue.end() && distance(from, to) < 1.5; ++task) {
    from = to;
    to = task->place;
  }
  ASSERT_GT(distance(from, to), 1.5);
  const Vec2 box = from + 0.6 * (to - from);
  double nearest_m = std::numeric_limits<double>::infinity();
  guarded.bus.start(std::make_unique<BoxScanner>(guarded.sim().robot(), box));
  guarded.bus.look = [&](const std::string&, const std::string&) {
    nearest_m = std::min(nearest_m, distance(guarded.sim().robot().pose().position, box));
  };
  ASSERT_TRUE(guarded.run(200.0)) << guarded.node().status().sentence;
  EXPECT_EQ(guarded.node().status().state, "blocked") << guarded.node().status().sentence;
  EXPECT_GT(nearest_m, guarded.scenario.problem.robot.radius_m + BoxScanner::half_m);
}

TEST(GuardBehindTopics, WhatTopicsCannotTellIsRefused) {
  GuardScenario scenario = yard(1);
  scenario.problem.supplies.tank = 5.0;
  EXPECT_EQ(GuardMissionNode::prepare(scenario, {}).error().where, "supplies");
  scenario = yard(1);
  scenario.arrivals.leave = 0.5;
  EXPECT_EQ(GuardMissionNode::prepare(scenario, {}).error().where, "arrivals.leave");
  scenario = yard(1);
  scenario.robots = 2;
  EXPECT_EQ(GuardMissionNode::prepare(scenario, {}).error().where, "robots");
  scenario = yard(1);
  scenario.scout.unknown = true;
  EXPECT_EQ(GuardMissionNode::prepare(scenario, {}).error().where, "scout.unknown");
}

/// Returns why the message was refused; empty if it was taken.
template <class Message>
std::string refused(RemoteGun& gun, const Message& message) {
  const Status ok = gun.take(message);
  return ok ? std::string() : ok.error().sentence;
}

std::string refused(RemoteGun& gun, const sensor_msgs::JointState& joints) {
  const Status ok = gun.take(joints, 1.0);
  return ok ? std::string() : ok.error().sentence;
}

TEST(RemoteGun, RefusesMessagesThatNoGoodNodeSends) {
  const auto targets = yard(2).problem.targets;
  RemoteGun gun(targets);
  EXPECT_NE(refused(gun, std_msgs::String{"nobody"}).find("no target has the name 'nobody'"),
            std::string::npos);
  EXPECT_NE(refused(gun, std_msgs::String{targets[0].name}).find("the gun was not fired at it"),
            std::string::npos);
  EXPECT_FALSE(gun.was_hit(0));
  gun.fire_at(0);
  EXPECT_EQ(refused(gun, std_msgs::String{targets[0].name}), "");
  EXPECT_TRUE(gun.was_hit(0));
  EXPECT_FALSE(gun.was_hit(1));
  sensor_msgs::JointState joints = joints_message({0.5, 0.25}, 5.0);
  EXPECT_EQ(refused(gun, joints), "");
  EXPECT_EQ(gun.joints()->yaw_rad, 0.5);
  EXPECT_EQ(gun.joints()->pitch_rad, 0.25);
  joints.position.pop_back();
  EXPECT_NE(refused(gun, joints).find("2 names and 1 positions"), std::string::npos);
  joints = joints_message({std::numeric_limits<double>::quiet_NaN(), 0.0}, 6.0);
  EXPECT_NE(refused(gun, joints).find("its joints are at nan"), std::string::npos);
  EXPECT_NE(refused(gun, joints_message({0.0, 0.0}, 4.0)).find("the time goes back"), std::string::npos);
  joints.name = {"left_wheel", "right_wheel"};
  joints.position = {1.0, 2.0};
  joints.header.stamp = stamp_of(1.0);
  EXPECT_EQ(refused(gun, joints), "");  // others may send joints too
  EXPECT_EQ(gun.joints()->yaw_rad, 0.5);
}

TEST(GuardSimNode, RefusesShotsThatTheGunCannotShoot) {
  GuardSimNode sim(GuardSimYard::make(yard(1)).value(), RobotSimOptions());
  for (std::size_t i = 0; i < sim.inputs().size(); ++i) {
    if (sim.inputs()[i].name != "gun/fire") continue;
    for (const double speed : {0.0, -3.0, 1e9, std::numeric_limits<double>::quiet_NaN()})
      sim.receive(i, encode(MessageEncoding::cdr, std_msgs::Float64{speed}), 1.0);
  }
  for (double time_s = 1.0; time_s < 3.0; time_s += 0.05) sim.tick(time_s);
  EXPECT_EQ(sim.shots(), 0);
}

}  // namespace
}  // namespace outrider
