// Mapper, explorer, planner, follower and a simulated robot explore the office through messages alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "outrider/jobs/explore/map/reference.hpp"
#include "outrider/jobs/explore/scenario.hpp"
#include "outrider/nodes/explorer_node.hpp"
#include "outrider/nodes/follower_node.hpp"
#include "outrider/nodes/mapper_node.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/missions/explore_mission_node.hpp"
#include "outrider/nodes/planner_node.hpp"
#include "outrider/nodes/sim/sim_node.hpp"
#include "support/data.hpp"
#include "support/node_bus.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::NodeBus;

class Office {
 public:
  explicit Office(const MessageFaults& faults, std::uint64_t of_seed = 1, const ExplorerFaults& of_robot = {})
      : seed(of_seed), bus(faults) {
    ExploreScenario scenario;
    scenario.world.world = OUTRIDER_SOURCE_DIR "/scenarios/explore/office.sdf";
    scenario.start = "0.8,3,0";
    auto loaded = load_explore(scenario);
    EXPECT_TRUE(loaded) << to_string(loaded.error());
    setup = std::move(*loaded);
    setup.sim.faults = of_robot;

    for (const char* name : {"sim", "mapper", "planner", "explorer", "follower"}) start(name);
    bus.look = [this](const std::string& topic, const std::string& bytes) { look(topic, bytes); };
    bus.talk();
  }

  void start(const std::string& name) {
    if (name == "sim") {
      SimNodeOptions options;
      options.start = setup.task.start;
      options.robot = burger();
      options.sim = setup.sim;
      options.seed = seed;
      bus.start(std::make_unique<SimNode>(setup.world, options));
    }
    if (name == "mapper") bus.start(std::make_unique<MapperNode>(mapper));
    if (name == "planner") bus.start(std::make_unique<PlannerNode>(PlannerNodeOptions()));
    if (name == "follower") bus.start(std::make_unique<FollowerNode>(FollowerNodeOptions()));
    ExplorerNodeOptions explorer;
    explorer.home = "0,0,0";
    if (name == "explorer") bus.start(std::make_unique<ExplorerNode>(explorer));
  }

  void look(const std::string& topic, const std::string& bytes) {
    if (topic == "/map") {
      const auto message = decode<nav_msgs::OccupancyGrid>(MessageEncoding::cdr, bytes);
      map = checked_map(*message).value();
    }
    if (topic == "/cmd_vel") {
      const auto message = decode<geometry_msgs::TwistStamped>(MessageEncoding::cdr, bytes);
      moving = message->twist.linear.x != 0.0 || message->twist.angular.z != 0.0;
      if (moving) moved_s = bus.time_s();
    }
  }

  bool explored() {
    return bus.run(bus.time_s() + 1500.0, [this] {
      const std::string& state = bus.status("explorer").state;
      return state == "complete" || state == "left_over" || state == "lost" || state == "stuck" ||
             state == "leak";
    });
  }

  /// Returns the part of the office that a robot can see from where it can be, without margins.
  [[nodiscard]] ExplorationReference truth() const {
    return exploration_reference(sim().devices().laser->finder(), sim().body<TwistBody>().ground(),
                                 setup.task.start.position)
        .value();
  }
  /// The map of the nodes has its origin where the robot starts.
  [[nodiscard]] MapQuality quality() const {
    Grid<std::uint8_t> placed = map;
    placed.frame.origin = placed.frame.origin + setup.task.start.position;  // its heading is 0
    return map_quality(truth(), sim().devices().laser->finder(), placed);
  }
  /// Returns the area of it that the map does not have.
  [[nodiscard]] double missing_m2() const { return (1.0 - quality().explored_fraction) * truth().seeable_m2; }
  [[nodiscard]] const SimulatedRobot& sim() const { return bus.node<SimNode>("sim").robot(); }
  [[nodiscard]] std::int64_t contacts() const { return sim().body<TwistBody>().contacts(); }

  std::uint64_t seed;
  ExploreSetup setup;
  MapperNodeOptions mapper;
  NodeBus bus;
  Grid<std::uint8_t> map;
  bool moving = false;
  double moved_s = 0.0;
};

void expect_home(const Office& office) {
  EXPECT_EQ(office.contacts(), 0);
  EXPECT_LT(distance(office.sim().pose().position, office.setup.task.start.position), 0.3);
}

/// Returns true if nothing is left over but what lies behind gaps that are too narrow.
bool only_narrow(const NodeStatus& end) {
  return end.state == "left_over" && end.sentence.find("because: too narrow (") != std::string::npos &&
         end.sentence.find(';') == end.sentence.rfind(';');
}

void expect_mapped(const Office& office, bool may_leave_narrow = false) {
  const NodeStatus& end = office.bus.status("explorer");
  EXPECT_TRUE(end.state == "complete" || (may_leave_narrow && only_narrow(end)))
      << end.state << ": " << end.sentence;
  expect_home(office);
  const MapQuality quality = office.quality();
  EXPECT_GT(quality.explored_fraction, 0.99);
  EXPECT_LT(quality.map_error_m, 0.05);
  EXPECT_LT(office.missing_m2(), ExploreOptions().least_left_m2);
}

TEST(FiveNodes, MapTheOfficeAndComeHome) {
  Office office({});
  ASSERT_TRUE(office.explored());
  expect_mapped(office);
}

TEST(FiveNodes, MapTheOfficeThoughMessagesAreLostAndLate) {
  for (int seed = 2; seed <= std::min(16, 1 + testing::cases(1));
       ++seed) {  // the others below have the first
    SCOPED_TRACE(seed);
    Office office({.loss = 0.01, .delay_s = 0.1}, static_cast<std::uint64_t>(seed));
    ASSERT_TRUE(office.explored());
    expect_mapped(office);
  }
}

/// The explorer knows nothing but the map; the mapper finds out that its ranges are off.
TEST(FiveNodes, AMapThatTheMapperDoubtsIsNotCalledComplete) {
  ExplorerFaults off;
  off.bias_m = 0.08;
  Office office({}, 1, off);
  ASSERT_TRUE(office.explored());
  EXPECT_EQ(office.bus.status("mapper").state, "doubtful");
  const NodeStatus& end = office.bus.status("explorer");
  EXPECT_EQ(end.state, "lost");
  EXPECT_NE(end.sentence.find("all ranges were 0.08 m too long"), std::string::npos) << end.sentence;
}

TEST(FiveNodes, ARobotThatWasCarriedAndFoundItsPlaceAgainIsBelieved) {
  ExplorerFaults carried;
  carried.kidnapping = {15.0, 1.0, 1.5};
  Office office({}, 1, carried);
  ASSERT_TRUE(office.explored());
  EXPECT_GT(office.bus.time_s(), carried.kidnapping.at_s);
  expect_mapped(office);
}

TEST(FiveNodes, DoTheSameEachTime) {
  Office one({.loss = 0.05, .delay_s = 0.05}), other({.loss = 0.05, .delay_s = 0.05});
  one.bus.run(30.0);
  other.bus.run(30.0);
  EXPECT_EQ(one.sim().pose(), other.sim().pose());
  EXPECT_EQ(one.map.cells, other.map.cells);
}

/// Nobody knows where home is on the map of another mapper: the robot stays where it is, and that is said.
void expect_rest(Office& office) {
  const Pose2 stood = office.sim().pose();
  office.bus.run(office.bus.time_s() + 30.0);
  EXPECT_EQ(office.bus.status("explorer").state, "map_lost");
  EXPECT_LT(distance(stood.position, office.sim().pose().position), 0.5);
  EXPECT_EQ(office.sim().body<TwistBody>().twist(), Twist2{});
  EXPECT_EQ(office.contacts(), 0);
  office.start("explorer");  // it explores the new map
  office.bus.run(office.bus.time_s() + 20.0);
  EXPECT_EQ(office.bus.status("explorer").state, "exploring");
  EXPECT_EQ(office.contacts(), 0);
}

class OneIsKilled : public ::testing::TestWithParam<const char*> {};

/// Whoever is killed: the robot stops or drives on to where it was sent, and what is started anew goes on.
TEST_P(OneIsKilled, AndStartedAnew) {
  const std::string name = GetParam();
  Office office({.loss = 0.01, .delay_s = 0.1});
  office.bus.run(60.0);
  ASSERT_TRUE(office.moving);
  const double killed_s = office.bus.time_s();
  office.bus.kill(name);
  office.bus.run(killed_s + 30.0);
  if (name == "mapper") {
    EXPECT_LE(office.moved_s, killed_s + 0.5 + 0.1);  // a message was on its way
    EXPECT_EQ(office.bus.status("follower").state, "stopped");
    EXPECT_EQ(office.bus.status("follower").sentence, "no transform from 'map' to 'odom' has come for 0.4 s");
  }
  EXPECT_EQ(office.sim().body<TwistBody>().twist(), Twist2{});
  EXPECT_EQ(office.contacts(), 0);
  office.start(name);
  if (name == "mapper") return expect_rest(office);
  ASSERT_TRUE(office.explored());
  expect_mapped(office, name == "planner");  // a gap that it cannot reach meanwhile is not measured
}

/// Returns how many constraints of its graph join a keyframe of the kept map to one after.
std::ptrdiff_t joints_across(const MapperNode& mapper) {
  const PoseGraph graph = mapper.slam()->pose_graph();
  const auto is_kept = [&](std::uint32_t node) {
    return std::stoul(graph.nodes[node].name) < mapper.replayed_steps();
  };
  return std::ranges::count_if(graph.edges,
                               [&](const GraphEdge& edge) { return is_kept(edge.from) != is_kept(edge.to); });
}

TEST(FiveNodes, AMapperThatKeepsItsMapGoesOnWithIt) {
  const test::Folder folder;
  Office office({.loss = 0.01, .delay_s = 0.1});
  office.mapper.keep = (folder.path / "map.yaml").string();
  office.start("mapper");
  office.bus.run(80.0);
  const Grid<std::uint8_t> before = office.map;
  office.bus.kill("mapper");
  office.bus.run(90.0);
  office.start("mapper");
  office.bus.run(95.0);
  EXPECT_NE(office.bus.status("explorer").state, "map_lost");
  std::size_t lost = 0, known = 0;  // cells that the kept map is up to 2 s behind, and those before
  for (std::size_t i = 0; i < before.cells.size(); ++i) {
    if (before.cells[i] == unknown_cell) continue;
    const Cell now = office.map.frame.cell_at(before.frame.centre(before.frame.cell(i)));
    ++known;
    lost += !office.map.contains(now) || office.map[now] == unknown_cell;
  }
  EXPECT_LT(static_cast<double>(lost), 0.1 * static_cast<double>(known));
  ASSERT_TRUE(office.explored());
  const auto& mapper = office.bus.node<MapperNode>("mapper");
  EXPECT_GT(mapper.replayed_steps(), 50U);
  EXPECT_GT(joints_across(mapper), 5);
  expect_mapped(office);
}

TEST(FiveNodes, AKeptMapOfAnotherPlaceIsNotGoneOnWith) {
  const test::Folder folder;
  Office office({});
  office.mapper.keep = (folder.path / "map.yaml").string();
  office.start("mapper");
  office.bus.run(60.0);
  office.bus.kill("mapper");
  KeptMap kept = load_kept_map(office.mapper.keep).value().value();
  kept.map_T_odom.position.x += 1.0;  // as if the odometry had begun anew
  ASSERT_TRUE(save(office.mapper.keep, kept));
  office.start("mapper");
  office.bus.run(70.0);
  EXPECT_EQ(office.bus.status("explorer").state, "map_lost");
}

TEST(KeptMap, ComesBackAsItWasAndWhatIsNoneIsRefused) {
  const test::Folder folder;
  const std::string path = (folder.path / "map.yaml").string();
  EXPECT_FALSE(load_kept_map(path).value());
  KeptMap kept{Grid<std::uint8_t>({{-1.0, 0.5}, 0.05, 30, 20}, unknown_cell),
               1'732'624'153.123456789,
               {{0.1, -2.0}, 3.0},
               {}};
  kept.occupancy[{4, 5}] = occupied_cell;
  kept.occupancy[{6, 5}] = free_cell;
  LaserScan scan;
  scan.time_s = 1'732'624'160.5;
  scan.step_rad = 0.1;
  scan.least_m = 0.1;
  scan.most_m = 3.5;
  scan.ranges_m = {1.0F, 2.5F, std::numeric_limits<float>::infinity(), 0.4F};
  kept.scans = {{{{0.5, 0.25}, 0.75}, scan}, {{{0.7, 0.2}, -3.0}, scan}};
  ASSERT_TRUE(save(path, kept));
  const KeptMap back = load_kept_map(path).value().value();
  EXPECT_EQ(back.occupancy.frame, kept.occupancy.frame);
  EXPECT_EQ(back.occupancy.cells, kept.occupancy.cells);
  EXPECT_EQ(back.begun_s, kept.begun_s);
  EXPECT_EQ(back.map_T_odom, kept.map_T_odom);
  ASSERT_EQ(back.scans.size(), 2U);
  EXPECT_EQ(back.scans[0].scan.ranges_m, scan.ranges_m);
  EXPECT_LT(distance(back.scans[1].map_T_robot.position, kept.scans[1].map_T_robot.position), 1e-12);
  EXPECT_NEAR(back.scans[1].map_T_robot.heading_rad, -3.0, 1e-12);
  MapperNodeOptions options;
  options.keep = path;
  options.slam.map.resolution_m = 0.1;
  EXPECT_EQ(MapperNode::checked(options).error().where, path);
  folder.write("map.state", "begun now");
  EXPECT_NE(MapperNode::checked(options).error().sentence.find("it has to say 'begun TIME'"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(FiveNodes, OneIsKilled,
                         ::testing::Values("mapper", "planner", "explorer", "follower"));

TEST(ExploreMissionNode, MapsTheOfficeAndComesHome) {
  Office office({});
  for (const char* name : {"mapper", "planner", "explorer", "follower"}) office.bus.kill(name);
  ExploreMissionNodeOptions options;
  options.task = office.setup.task;
  office.bus.start(std::make_unique<ExploreMissionNode>(options));
  const auto over = [&] { return office.bus.node<ExploreMissionNode>("explore").is_over(); };
  ASSERT_TRUE(office.bus.run(1500.0, over));
  // The job counts what lies behind gaps that are too narrow as left over.
  const NodeStatus& end = office.bus.status("explore");
  EXPECT_TRUE(end.state == "complete" || only_narrow(end)) << end.state << ": " << end.sentence;
  expect_home(office);
  EXPECT_GT(office.quality().explored_fraction, 0.99);
}

TEST(ExploreMissionNode, StandsWithoutARobotAndSaysWhy) {
  Office office({});
  for (const char* name : {"mapper", "planner", "explorer", "follower"}) office.bus.kill(name);
  office.bus.start(std::make_unique<ExploreMissionNode>(ExploreMissionNodeOptions()));
  office.bus.run(20.0);
  ASSERT_TRUE(office.moving);
  office.bus.kill("sim");
  office.bus.run(20.5);
  EXPECT_FALSE(office.moving);
  EXPECT_EQ(office.bus.status("explore").sentence, "no odometry has come for 0.4 s");
}

/// The base of the robot stops by itself when nobody commands it.
TEST(FiveNodes, WithoutTheFollowerTheRobotStopsWithinHalfASecond) {
  Office office({});
  office.bus.run(60.0);
  ASSERT_TRUE(office.moving);
  office.bus.kill("follower");
  const double killed_s = office.bus.time_s();
  const auto stands = [&] { return office.sim().body<TwistBody>().twist() == Twist2{}; };
  ASSERT_TRUE(office.bus.run(killed_s + 2.0, stands));
  EXPECT_LE(office.bus.time_s(), killed_s + 0.5 + 0.3);  // and brakes
  EXPECT_NE(office.bus.status("sim").sentence.find("no command has come for 0.5 s"), std::string::npos);
}

}  // namespace
}  // namespace outrider
