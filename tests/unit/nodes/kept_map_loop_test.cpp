// A mapper that is started anew closes a loop with what the one before it mapped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "outrider/jobs/explore/scenario.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/nodes/mapper_node.hpp"
#include "outrider/nodes/sim/sim_node.hpp"
#include "support/data.hpp"
#include "support/node_bus.hpp"

namespace outrider {
namespace {

using testing::NodeBus;

constexpr double outer_m = 14.0, corridor_m = 2.0;

/// A corridor around a block. Columns on its walls tell places apart.
World ring() {
  World world;
  const auto block = [&](Vec2 low, Vec2 high) {
    Solid solid;
    solid.shape = BoxShape{{0.5 * (high.x - low.x), 0.5 * (high.y - low.y), 0.5}};
    solid.world_T_solid.position = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5};
    world.solids.push_back(solid);
  };
  const double thick_m = 0.2, inner_m = outer_m - corridor_m;
  block({-thick_m, -thick_m}, {outer_m + thick_m, 0.0});
  block({-thick_m, outer_m}, {outer_m + thick_m, outer_m + thick_m});
  block({-thick_m, 0.0}, {0.0, outer_m});
  block({outer_m, 0.0}, {outer_m + thick_m, outer_m});
  block({corridor_m, corridor_m}, {inner_m, inner_m});
  Rng rng(11);
  for (double at = 1.0; at < outer_m - 1.0; at += rng.uniform(0.9, 1.6)) {
    const double out_m = rng.uniform(0.1, 0.3);
    block({at, 0.0}, {at + 0.3, out_m});
    block({outer_m - at - 0.3, outer_m - out_m}, {outer_m - at, outer_m});
    block({0.0, at}, {out_m, at + 0.25});
    block({outer_m - out_m, outer_m - at - 0.25}, {outer_m, outer_m - at});
  }
  world.bounds = {{-1.0, -1.0}, {outer_m + 1.0, outer_m + 1.0}};
  return world;
}

/// Drives a robot around the corridor by its true pose, as long as it may.
class RoundNode final : public Node {
 public:
  explicit RoundNode(const SimulatedRobot& robot) : Node("round", 0.05), robot_(robot) {
    output_ = add_output<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable);
  }
  int corners = 0;  ///< that it has passed
  bool waits = false;

 private:
  void act() override {
    constexpr double near_m = 0.5 * corridor_m, far_m = outer_m - near_m;
    constexpr Vec2 places[] = {{far_m, near_m}, {far_m, far_m}, {near_m, far_m}, {near_m, near_m}};
    const Pose2& pose = robot_.pose();
    const Vec2 to = places[corners % 4] - pose.position;
    if (norm(to) < 0.2) ++corners;
    const double off_rad = wrap_angle(std::atan2(to.y, to.x) - pose.heading_rad);
    geometry_msgs::TwistStamped command;
    command.header = header_of(now_s(), "base_link");
    if (!waits) {
      command.twist.linear.x = std::abs(off_rad) < 0.3 ? 0.4 : 0.0;
      command.twist.angular.z = std::clamp(2.0 * off_rad, -1.0, 1.0);
    }
    send(output_, command);
  }

  const SimulatedRobot& robot_;
  std::size_t output_;
};

TEST(KeptMap, ALoopClosesBetweenTheMapBeforeAndAfter) {
  const test::Folder folder;
  NodeBus bus;
  bus.talk();
  SimNodeOptions sim;
  sim.start = {{1.0, 1.0}, 0.0};
  sim.robot = burger();
  sim.robot.speed_mps = 0.5;
  bus.start(std::make_unique<SimNode>(ring(), sim));
  const SimulatedRobot& robot = bus.node<SimNode>("sim").robot();
  auto made = std::make_unique<RoundNode>(robot);
  RoundNode& round = *made;
  bus.start(std::move(made));
  MapperNodeOptions options;
  options.keep = (folder.path / "map.yaml").string();
  bus.start(std::make_unique<MapperNode>(options));
  ASSERT_TRUE(bus.run(400.0, [&] { return round.corners == 3; }));
  bus.run(bus.time_s() + 5.0);
  round.waits = true;
  bus.run(bus.time_s() + 4.0);
  bus.kill("mapper");
  bus.run(bus.time_s() + 2.0);
  bus.start(std::make_unique<MapperNode>(options));
  bus.run(bus.time_s() + 1.0);
  round.waits = false;
  const auto& mapper = bus.node<MapperNode>("mapper");
  ASSERT_TRUE(bus.run(bus.time_s() + 400.0, [&] { return round.corners == 5; }));
  const auto kept = mapper.replayed_steps();
  EXPECT_GT(kept, 60U);
  const auto loops = mapper.slam()->closed_loops();
  EXPECT_TRUE(
      std::ranges::any_of(loops, [&](const LaserLoop& loop) { return loop.from <= kept && loop.to > kept; }))
      << loops.size() << " loops";
  const Pose2 believed = mapper.slam()->pose();  // the map begins where the robot started
  EXPECT_LT(distance(believed.position + sim.start.position, robot.pose().position), 0.1);
  EXPECT_EQ(robot.body<TwistBody>().contacts(), 0);
}

}  // namespace
}  // namespace outrider
