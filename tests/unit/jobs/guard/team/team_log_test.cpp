#include "team/team_report.hpp"

#include <gtest/gtest.h>

#include "outrider/log/append.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

TEST(AppendTeam, MergesByTimeAndKeepsEveryRobotApart) {
  TeamRun team;
  team.robots.resize(3);
  for (std::size_t r = 0; r < team.robots.size(); ++r) {
    Log& robot = team.robots[r].log;
    for (int i = 0; i < 4; ++i) {
      const double time_s = i + 0.25 * static_cast<double>(r);
      log_pose(robot, time_s, {{static_cast<double>(r), static_cast<double>(i)}, 0.0});
      log_event(robot, time_s, "arrive", "it is there");
    }
    outrider_msgs::Shot shot;
    shot.target = std::string(1, static_cast<char>('a' + r));
    robot.append(topic::shots, 3.0 - static_cast<double>(r), shot);
  }
  for (std::size_t r = 0; r < 3;
       ++r) {  // each robot logs all targets at first, and then what changes of its own
    for (const char* name : {"a", "b", "c"}) {
      outrider_msgs::Target target;
      target.name = name;
      target.status = "waiting";
      team.robots[r].targets.append(topic::targets, 0.0, target);
    }
    outrider_msgs::Target reached;
    reached.name = std::string(1, static_cast<char>('a' + r));
    reached.status = "reached";
    team.robots[r].targets.append(topic::targets, 4.0 - static_cast<double>(r), reached);
  }
  Log log;
  append_team(log, team);
  const auto& targets = log.messages<outrider_msgs::Target>(topic::targets);
  ASSERT_EQ(targets.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(targets[i].message.status, i < 3 ? "waiting" : "reached");
  EXPECT_EQ(targets[3].message.name, "c");
  EXPECT_EQ(targets[5].message.name, "a");
  for (std::size_t r = 0; r < team.robots.size(); ++r) {
    const std::string topic = r == 0 ? "/pose" : r == 1 ? "/robot_2/pose" : "/robot_3/pose";
    const auto& poses = log.messages<geometry_msgs::PoseStamped>(topic);
    ASSERT_EQ(poses.size(), 4U) << topic;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(poses[i].message.pose.position.x, static_cast<double>(r));
      EXPECT_EQ(poses[i].time_s(), static_cast<double>(i) + 0.25 * static_cast<double>(r));
    }
  }
  const auto events = events_of(log, "arrive");
  ASSERT_EQ(events.size(), 12U);
  EXPECT_EQ(events[0].message.msg, "robot 1: it is there");
  EXPECT_EQ(events[1].message.msg, "robot 2: it is there");
  for (std::size_t i = 1; i < events.size(); ++i) EXPECT_GE(events[i].time_ns, events[i - 1].time_ns);
  const auto& shots = log.messages<outrider_msgs::Shot>(topic::shots);
  ASSERT_EQ(shots.size(), 3U);
  EXPECT_EQ(shots[0].message.target, "c");
  EXPECT_EQ(shots[2].time_s(), 3.0);
}

}  // namespace
}  // namespace outrider
