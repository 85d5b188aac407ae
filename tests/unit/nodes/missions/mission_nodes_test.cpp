// Missions of jobs with their robot on the other side of topics: a simulated robot on the same bus.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/nodes/missions/cover_mission_node.hpp"
#include "outrider/nodes/missions/drive_mission_node.hpp"
#include "outrider/nodes/missions/pursue_mission_node.hpp"
#include "outrider/nodes/sim/sim_node.hpp"
#include "outrider/nodes/sim/tag_sim_node.hpp"
#include "support/node_bus.hpp"
#include "support/published.hpp"
#include "support/room.hpp"

namespace outrider {
namespace {

using testing::NodeBus;
using testing::Published;

class CoverBehindTopics : public testing::CoverOfTheRoom {};

TEST_F(CoverBehindTopics, CoversTheMapFromWhereTheRobotStands) {
  NodeBus bus;
  bus.talk();
  Published published(bus);
  start_robot(bus);
  bus.start(std::make_unique<CoverMissionNode>(MissionNodeOptions(), scenario));
  const auto& node = bus.node<CoverMissionNode>("cover");
  ASSERT_TRUE(bus.run(1500.0, [&] { return node.is_over(); })) << node.status().sentence;
  EXPECT_EQ(node.status().state, "done") << node.status().sentence;
  const auto& robot = bus.node<SimNode>("sim").robot();
  EXPECT_EQ(robot.body<TwistBody>().contacts(), 0);
  EXPECT_LT(node.drive().tracking_error_m, 0.05);
  published.expect_same<outrider_msgs::Coverage>(node.log(), topic::coverage);
  published.expect_same<outrider_msgs::CoverageArea>(node.log(), topic::coverage_area);
  published.expect_same<outrider_msgs::RunInfo>(node.log(), topic::run);
  for (const std::string& bytes : published.all().at("/tf")) {
    const auto message = decode<tf2_msgs::TFMessage>(MessageEncoding::cdr, bytes).value();
    for (const auto& transform : message.transforms)
      ASSERT_NE(transform.header.frame_id + ">" + transform.child_frame_id, "map>base_link");
  }
  EXPECT_GT(node.log().latest<outrider_msgs::Coverage>(topic::coverage)->covered,
            0.97 * (2.9 * 2.4 - 0.0625));
}

TEST_F(CoverBehindTopics, StandsStillWhileNobodySaysWhereItIsAndGoesOn) {
  NodeBus bus;
  bus.talk();
  start_robot(bus);
  bus.start(std::make_unique<CoverMissionNode>(MissionNodeOptions(), scenario));
  bus.run(20.0);
  EXPECT_EQ(bus.status("cover").state, "covering");
  double moved_s = 0.0;
  bus.look = [&](const std::string& topic, const std::string& bytes) {
    if (topic != "/cmd_vel") return;
    const auto command = decode<geometry_msgs::TwistStamped>(MessageEncoding::cdr, bytes);
    if (command->twist.linear.x != 0.0 || command->twist.angular.z != 0.0) moved_s = bus.time_s();
  };
  bus.kill("sim");
  bus.run(30.0);
  EXPECT_LT(moved_s, 20.5);
  EXPECT_EQ(bus.status("cover").state, "stopped");
  EXPECT_EQ(bus.status("cover").sentence, "no odometry has come for 0.4 s");
}

TEST_F(CoverBehindTopics, ARobotElsewhereThanTheStartIsToldSo) {
  NodeBus bus;
  start_robot(bus);
  scenario.start = "1.9,1.5,0";
  bus.start(std::make_unique<CoverMissionNode>(MissionNodeOptions(), scenario));
  bus.run(2.0);
  EXPECT_TRUE(bus.node<CoverMissionNode>("cover").is_over());
  EXPECT_NE(bus.status("cover").sentence.find("the robot stands 2.08 m from the start"), std::string::npos)
      << bus.status("cover").sentence;
}

/// The bundled closed loop, with sightings of a model, since images take long.
DriveSetup drive_setup(const std::string& sight) {
  DriveJob job;
  const auto read = read_scenario(job, OUTRIDER_SOURCE_DIR "/scenarios/waypoints/closed_loop.yaml");
  EXPECT_TRUE(read) << to_string(read.error());
  job.scenario.sight = sight;
  auto setup = load_drive(job.scenario);
  EXPECT_TRUE(setup) << to_string(setup.error());
  return std::move(*setup);
}

void expect_at_last_waypoint(const NodeBus& bus, const DriveSetup& setup) {
  const Pose2& robot = bus.node<TagSimNode>("sim").robot().pose();
  EXPECT_LT(distance(robot.position, setup.task.waypoints.back().pose.position), 0.03);
}

TEST(DriveBehindTopics, GoesToTheWaypointsByDetectionsOfTags) {
  NodeBus bus({.loss = 0.0, .delay_s = 0.05});
  bus.talk();
  Published published(bus);
  const DriveSetup setup = drive_setup("modelled");
  bus.start(std::make_unique<TagSimNode>(setup, TagSimNodeOptions()));
  DriveMissionNodeOptions options;
  options.task = setup.task;
  options.task.eye.camera.fx = 1.0;  // the lens and the place of the camera come on topics
  options.task.eye.ahead_m = 5.0;
  bus.start(std::make_unique<DriveMissionNode>(options));
  const auto& node = bus.node<DriveMissionNode>("drive");
  ASSERT_TRUE(bus.run(600.0, [&] { return node.is_over(); })) << node.status().sentence;
  EXPECT_EQ(node.status().state, "done") << node.status().sentence;
  expect_at_last_waypoint(bus, setup);
  published.expect_same<outrider_msgs::Waypoints>(node.log(), topic::waypoints);
  published.expect_same<outrider_msgs::Tags>(node.log(), topic::tags);
  published.expect_same<geometry_msgs::PoseWithCovarianceStamped>(node.log(), topic::belief);
}

TEST(DriveBehindTopics, FindsTheTagsInImagesToo) {
  NodeBus bus;
  bus.talk();
  DriveSetup setup = drive_setup("rendered");
  setup.task.waypoints.resize(1);
  setup.task.waypoints.front().stop = true;
  TagSimNodeOptions sim;
  sim.images = true;
  bus.start(std::make_unique<TagSimNode>(setup, sim));
  DriveMissionNodeOptions options;
  options.task = setup.task;
  bus.start(std::make_unique<DriveMissionNode>(options));
  const auto& node = bus.node<DriveMissionNode>("drive");
  ASSERT_TRUE(bus.run(100.0, [&] { return node.is_over(); })) << node.status().sentence;
  EXPECT_EQ(node.status().state, "done") << node.status().sentence;
  EXPECT_GT(node.mission()->used, 3);
  expect_at_last_waypoint(bus, setup);
}

/// Sends where the target is: to and fro along a row of cells.
class TargetNode final : public Node {
 public:
  explicit TargetNode(double second_s) : Node("target", 0.1), second_s_(second_s) {
    output_ = add_output<geometry_msgs::PoseStamped>("target_pose", Delivery::reliable);
  }
  [[nodiscard]] Vec2 at() const {
    const double phase = std::fmod(now_s() / second_s_, 12.0);
    return {4.5 + (phase < 6.0 ? phase : 12.0 - phase), 6.5};
  }

 private:
  void act() override { send(output_, stamped(now_s(), {at(), 0.0})); }
  double second_s_;
  std::size_t output_ = 0;
};

PursuitTask pursuit_task() {
  auto costs = std::make_shared<CostGrid>(GridFrame{{0.0, 0.0}, 1.0, 12, 9}, 1U);
  for (int y = 2; y < 7; ++y) (*costs)[{3, y}] = 100;
  PursuitTask task;
  task.problem.costs = costs;
  task.problem.threshold = 100;
  task.problem.target.assign(200, Cell{4, 6});
  task.robots = {Cell{1, 1}};
  return task;
}

TEST(PursueBehindTopics, CatchesWhoWalksToAndFro) {
  NodeBus bus;
  bus.talk();
  Published published(bus);
  World field;
  field.bounds = {{0.0, 0.0}, {12.0, 9.0}};
  SimNodeOptions sim;
  sim.start = {{1.5, 1.5}, 0.0};
  sim.robot = burger();
  sim.robot.speed_mps = 2.0;
  sim.robot.acceleration_mps2 = 3.0;
  sim.robot.turn_rate_radps = 6.0;
  sim.localised = true;
  bus.start(std::make_unique<SimNode>(field, sim));
  bus.start(std::make_unique<TargetNode>(9.0));
  PursueMissionNodeOptions options;
  options.second_s = 3.0;
  options.pace.speed_mps = 1.0;
  options.pace.acceleration_mps2 = 3.0;
  options.pace.turn_rate_radps = 3.0;
  options.pace.turn_acceleration_radps2 = 10.0;
  bus.start(std::make_unique<PursueMissionNode>(options, pursuit_task(), "field"));
  const auto& node = bus.node<PursueMissionNode>("pursue");
  ASSERT_TRUE(bus.run(600.0, [&] { return node.is_over(); })) << node.status().sentence;
  EXPECT_EQ(node.status().state, "caught") << node.status().sentence;
  const Vec2 robot = bus.node<SimNode>("sim").robot().pose().position,
             target = bus.node<TargetNode>("target").at();
  EXPECT_EQ(std::floor(robot.x), std::floor(target.x));
  EXPECT_EQ(std::floor(robot.y), std::floor(target.y));
  published.expect_same<outrider_msgs::PaidCost>(node.log(), topic::paid);
  published.expect_same<geometry_msgs::PoseStamped>(node.log(), topic::pose);
}

TEST(PursueBehindTopics, StandsStillWithoutTheTarget) {
  NodeBus bus;
  World field;
  field.bounds = {{0.0, 0.0}, {12.0, 9.0}};
  SimNodeOptions sim;
  sim.start = {{1.5, 1.5}, 0.0};
  sim.robot = burger();
  sim.localised = true;
  bus.start(std::make_unique<SimNode>(field, sim));
  bus.start(std::make_unique<PursueMissionNode>(PursueMissionNodeOptions(), pursuit_task(), "field"));
  bus.run(5.0);
  EXPECT_EQ(bus.status("pursue").sentence, "the target was not seen yet");
  bus.start(std::make_unique<TargetNode>(3.0));
  bus.run(8.0);
  EXPECT_EQ(bus.status("pursue").state, "pursuing");
  bus.kill("target");
  bus.run(12.0);
  EXPECT_EQ(bus.status("pursue").sentence, "the target was not seen for 2 s");
}

/// A wall that is not on the grid lies between the robot and the target.
TEST(PursueBehindTopics, StopsForWhatTheScanShows) {
  NodeBus bus;
  bus.talk();
  World field;
  field.bounds = {{0.0, 0.0}, {12.0, 9.0}};
  field.solids.push_back({"wall", {{6.0, 4.5, 0.5}, {}}, BoxShape{{6.0, 0.05, 0.5}}});
  SimNodeOptions sim;
  sim.start = {{1.5, 1.5}, 0.0};
  sim.robot = burger();
  sim.localised = true;
  bus.start(std::make_unique<SimNode>(field, sim));
  bus.start(std::make_unique<TargetNode>(9.0));
  PursueMissionNodeOptions options;
  options.second_s = 10.0;
  options.radius_m = 0.105;
  options.pace.speed_mps = 0.2;
  options.pace.acceleration_mps2 = 0.5;
  bus.start(std::make_unique<PursueMissionNode>(options, pursuit_task(), "field"));
  const auto& node = bus.node<PursueMissionNode>("pursue");
  ASSERT_TRUE(bus.run(600.0, [&] { return node.is_over(); })) << node.status().sentence;
  EXPECT_EQ(node.status().state, "blocked") << node.status().sentence;
  EXPECT_EQ(bus.node<SimNode>("sim").robot().body<TwistBody>().contacts(), 0);
  EXPECT_GT(bus.node<SimNode>("sim").robot().pose().position.y, 3.5);
}

TEST(PursueBehindTopics, ATeamIsNotOneRobot) {
  PursuitTask task = pursuit_task();
  task.robots.resize(2);
  EXPECT_EQ(PursueMissionNode::check({}, task).error().where, "pursuers");
  PursuitScenario scenario;
  scenario.clock = "wall";
  EXPECT_EQ(PursueMissionNode::check(scenario, pursuit_task()).error().where, "clock");
}

TEST(MissionNodes, FaultsOfASimulationAreRefused) {
  PursuitScenario pursuit;
  EXPECT_TRUE(PursueMissionNode::check(pursuit, pursuit_task()));
  pursuit.faults.stuck_from_s = 3.0;
  EXPECT_EQ(PursueMissionNode::check(pursuit, pursuit_task()).error().where, "faults");
  CoverScenario cover;
  cover.sim = "navigator";
  EXPECT_EQ(CoverMissionNode::check(cover).error().where, "sim");
  EXPECT_TRUE(check_no_faults(false));
  EXPECT_EQ(check_no_faults(true, "faults.planner_fails_from").error().where, "faults.planner_fails_from");
}

}  // namespace
}  // namespace outrider
