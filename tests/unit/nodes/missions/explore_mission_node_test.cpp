// The mission of the job explore with its robot behind topics: what is published is what is logged.
#include "outrider/nodes/missions/explore_mission_node.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "support/published.hpp"
#include "support/room.hpp"

namespace outrider {
namespace {

using testing::NodeBus;
using testing::Published;
using ExploreBehindTopics = testing::RoomBehindTopics;

TEST_F(ExploreBehindTopics, PublishesTheChannelsOfItsRun) {
  NodeBus bus;
  bus.talk();
  Published published(bus);
  start_robot(bus, map_file(), false);
  ExploreMissionNodeOptions options;
  options.task.robot = burger();
  bus.run(5.0);  // the mission begins at another time than the node
  bus.start(std::make_unique<ExploreMissionNode>(options));
  const auto& node = bus.node<ExploreMissionNode>("explore");
  ASSERT_TRUE(bus.run(600.0, [&] { return node.is_over(); })) << node.status().sentence;
  bus.run(bus.time_s() + 0.1);
  EXPECT_EQ(node.status().state, "complete") << node.status().sentence;
  const Log& log = node.log();
  published.expect_same<outrider_msgs::RunInfo>(log, topic::run);
  published.expect_same<map_msgs::OccupancyGridUpdate>(log, topic::map_updates);
  published.expect_same<geometry_msgs::PoseStamped>(log, topic::pose);
  published.expect_same<geometry_msgs::PoseWithCovarianceStamped>(log, topic::belief);
  published.expect_same<outrider_msgs::Decision>(log, topic::decisions);
  published.expect_same<geometry_msgs::PoseStamped>(log, topic::goal);
  published.expect_same<nav_msgs::Path>(log, topic::plan);
  published.expect_all<nav_msgs::OccupancyGrid>(log, topic::map);
  published.expect_channels(log, {});
  const auto& box = log.messages<outrider_msgs::RunInfo>(topic::run).back().message;
  for (const double side : {box.high.x - box.low.x, box.high.y - box.low.y}) {  // what pictures show
    EXPECT_GT(side, 2.5 + 2.0 * 0.5);
    EXPECT_LT(side, std::hypot(3.0, 2.5) + 2.0 * 0.5 + 0.2);  // the room is turned
  }
  const auto first =
      decode<geometry_msgs::PoseStamped>(MessageEncoding::cdr, published.all().at("/pose").front()).value();
  EXPECT_NEAR(time_of(first.header.stamp).value(), 5.0, 0.3);
}

/// Whole maps are sent between the updates: who comes late has the newest at once.
TEST_F(ExploreBehindTopics, SendsWholeMapsToWhoComesLate) {
  NodeBus bus;
  Published published(bus);
  start_robot(bus, map_file(), false);
  ExploreMissionNodeOptions options;
  options.task.robot = burger();
  bus.start(std::make_unique<ExploreMissionNode>(options));
  bus.run(20.0);
  const auto& node = bus.node<ExploreMissionNode>("explore");
  EXPECT_GE(published.count("/map"), 10U);
  EXPECT_LT(node.log().messages<nav_msgs::OccupancyGrid>(topic::map).size(), published.count("/map"));
}

}  // namespace
}  // namespace outrider
