// Missions behind topics stop for what their scans show and their maps do not have, and touch nothing.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "outrider/job/run_job.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/nodes/missions/cover_mission_node.hpp"
#include "outrider/nodes/missions/drive_mission_node.hpp"
#include "outrider/nodes/sim/tag_sim_node.hpp"
#include "support/room.hpp"

namespace outrider {
namespace {

using testing::NodeBus;

class CoverWithAThingInTheWay : public testing::CoverOfTheRoom {
 protected:
  [[nodiscard]] std::string world() const { return (folder.path / "world.yaml").string(); }
};

TEST_F(CoverWithAThingInTheWay, ItStopsSaysWhyAndEndsWithoutContact) {
  for (const Vec2 at : {Vec2{1.6, 0.2}, Vec2{0.3, 1.2}, Vec2{2.0, 1.4}}) {
    save(world(), {at, at + Vec2{0.25, 0.25}});
    NodeBus bus;
    bus.talk();
    start_robot(bus, world());
    bus.start(std::make_unique<CoverMissionNode>(MissionNodeOptions(), scenario));
    const auto& node = bus.node<CoverMissionNode>("cover");
    ASSERT_TRUE(bus.run(1500.0, [&] { return node.status().state == "stopped"; })) << node.status().sentence;
    EXPECT_NE(node.status().sentence.find("that is not on the map, at about"), std::string::npos)
        << node.status().sentence;
    const double stopped_s = bus.time_s();
    ASSERT_TRUE(bus.run(1500.0, [&] { return node.is_over(); }));
    EXPECT_EQ(node.status().state, "blocked") << node.status().sentence;
    EXPECT_NEAR(bus.time_s() - stopped_s, 32.5, 2.5);  // it comes a little nearer at first
    bus.run(bus.time_s() + 1.0);
    const TwistBody& body = bus.node<SimNode>("sim").robot().body<TwistBody>();
    EXPECT_EQ(body.contacts(), 0);
    EXPECT_EQ(body.twist(), Twist2{});
    const Vec2 middle = at + Vec2{0.125, 0.125};
    EXPECT_GT(distance(body.pose().position, middle), 0.125 + 0.2);  // the disk that covers
  }
}

TEST_F(CoverWithAThingInTheWay, ItStandsStillWhenNoScanComesAnyMore) {
  NodeBus bus;
  start_robot(bus);
  bus.start(std::make_unique<CoverMissionNode>(MissionNodeOptions(), scenario));
  bus.run(10.0);
  ASSERT_EQ(bus.status("cover").state, "covering");
  bus.drop = [](const std::string& topic) { return topic == "/scan"; };
  bus.run(11.0);
  EXPECT_EQ(bus.status("cover").state, "stopped");
  EXPECT_EQ(bus.status("cover").sentence, "no scan has come for 0.4 s");
  bus.drop = {};
  bus.run(13.0);
  EXPECT_EQ(bus.status("cover").state, "covering");
}

/// Sends the scans of a range finder on a robot, from where it truly is.
class ScanNode final : public Node {
 public:
  explicit ScanNode(const SimulatedRobot& robot) : Node("scanner", 0.1), robot_(robot) {
    scan_output_ = add_output<sensor_msgs::LaserScan>("scan", Delivery::sensor);
    mount_output_ = add_output<tf2_msgs::TFMessage>("/tf_static", Delivery::latched);
  }
  World world;

 private:
  void act() override {
    const RangeFinder finder(footprints_above_floor(world), RangeFinderModel());
    send(mount_output_, tf2_msgs::TFMessage{{transform_of(now_s(), {}, "base_link", "laser")}});
    send(scan_output_, scan_message(finder.look(robot_.pose(), now_s(), rng_), now_s()));
  }

  const SimulatedRobot& robot_;
  Rng rng_{3};
  std::size_t scan_output_, mount_output_;
};

class DriveWithAThingInTheWay : public ::testing::Test {
 protected:
  void SetUp() override {
    DriveJob job;
    ASSERT_TRUE(read_scenario(job, OUTRIDER_SOURCE_DIR "/scenarios/waypoints/closed_loop.yaml"));
    job.scenario.sight = "modelled";
    auto loaded = load_drive(job.scenario);
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    setup = std::move(*loaded);
    bus.talk();
    bus.start(std::make_unique<TagSimNode>(setup, TagSimNodeOptions()));
    auto made = std::make_unique<ScanNode>(robot());
    scanner = made.get();
    scanner->world = setup.task.world;
    bus.start(std::move(made));
    DriveMissionNodeOptions options;
    options.task = setup.task;
    bus.start(std::make_unique<DriveMissionNode>(options));
    bus.look = [this](const std::string& topic, const std::string&) {
      if (topic == "/sim/pose" && thing) nearest_m = std::min(nearest_m, away_m());
    };
  }
  [[nodiscard]] const SimulatedRobot& robot() const { return bus.node<TagSimNode>("sim").robot(); }
  [[nodiscard]] const DriveMissionNode& node() const { return bus.node<DriveMissionNode>("drive"); }

  /// Puts a box there.
  void put(Vec2 middle) {
    thing = middle;
    Solid box;
    box.name = "box";
    box.shape = BoxShape{{half_m, half_m, 0.5}};
    box.world_T_solid.position = {middle.x, middle.y, 0.5};
    scanner->world.solids.push_back(box);
  }
  void take_away() {
    thing.reset();
    scanner->world = setup.task.world;
  }
  /// Returns the distance of the centre of the robot from the box.
  [[nodiscard]] double away_m() const {
    const Vec2 off = robot().pose().position - *thing;
    return norm(Vec2{std::max(0.0, std::abs(off.x) - half_m), std::max(0.0, std::abs(off.y) - half_m)});
  }

  static constexpr double half_m = 0.1;
  NodeBus bus;
  DriveSetup setup;
  ScanNode* scanner = nullptr;
  std::optional<Vec2> thing;
  double nearest_m = std::numeric_limits<double>::infinity();
};

TEST_F(DriveWithAThingInTheWay, ItStopsSaysWhyAndEndsWithoutContact) {
  put({0.6, 0.05});
  ASSERT_TRUE(bus.run(200.0, [&] { return node().is_over(); })) << node().status().sentence;
  EXPECT_EQ(node().status().state, "blocked") << node().status().sentence;
  EXPECT_NE(node().status().sentence.find("that is not on the map, at about"), std::string::npos);
  EXPECT_GT(nearest_m, setup.task.radius_m);
  EXPECT_LT(nearest_m, setup.task.radius_m + 0.15);
}

TEST_F(DriveWithAThingInTheWay, ItGoesOnOnceTheWayIsFree) {
  ASSERT_TRUE(bus.run(100.0, [&] { return node().mission() && !node().mission()->arrivals.empty(); }));
  put({1.0, 1.2});
  ASSERT_TRUE(bus.run(200.0, [&] { return node().status().state == "stopped"; })) << node().status().sentence;
  bus.run(bus.time_s() + 15.0);
  EXPECT_EQ(node().status().state, "stopped");
  EXPECT_GT(nearest_m, setup.task.radius_m);
  take_away();
  ASSERT_TRUE(bus.run(600.0, [&] { return node().is_over(); })) << node().status().sentence;
  EXPECT_EQ(node().status().state, "done") << node().status().sentence;
  EXPECT_LT(distance(robot().pose().position, setup.task.waypoints.back().pose.position), 0.03);
}

TEST_F(DriveWithAThingInTheWay, ItStandsStillWhenNoScanComesAnyMore) {
  bus.run(10.0);
  bus.kill("scanner");
  bus.run(12.0);
  EXPECT_EQ(node().status().state, "stopped");
  EXPECT_EQ(node().status().sentence, "no scan has come for 0.4 s");
  const Pose2 stood = robot().pose();
  bus.run(20.0);
  EXPECT_LT(distance(robot().pose().position, stood.position), 0.01);
}

}  // namespace
}  // namespace outrider
