#include "outrider/jobs/fleet/job.hpp"

#include <gtest/gtest.h>

#include "outrider/job/run_job.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

// A corridor of 5 cells with a bay in the middle; the second one has none.
const std::string bay = "type octile\nheight 2\nwidth 5\nmap\n@@.@@\n.....\n";
const std::string corridor = "type octile\nheight 2\nwidth 5\nmap\n@@@@@\n.....\n";

class FleetJobTest : public ::testing::Test {
 protected:
  static Outcome<outrider::Run> lead(const Changes& changes) {
    const Job job = fleet_job();
    const auto task = job.blank();
    if (auto ok = change(*task, changes); !ok) return pass_on(ok);
    return run_task(job, *task, {});
  }
  Changes passing(const std::string& map, Changes more = {}) const {
    Changes all{
        {"map", folder_.write("a.map", map)}, {"starts", "0.5,0.5 4.5,0.5"}, {"goals", "4.5,0.5 0.5,0.5"}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static std::string refusal(const Changes& changes) {
    const auto run = lead(changes);
    return run ? "taken, " + run->report.status : to_string(run.error());
  }
  test::Folder folder_;
};

TEST_F(FleetJobTest, LeadsTwoRobotsPastEachOther) {
  const auto run = lead(passing(bay, {{"planner", "cbs"}}));
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_EQ(run->report.status, "done");
  EXPECT_EQ(metric(run->report, "cost"), 11.0);
  EXPECT_EQ(metric(run->report, "optimal"), 1.0);
  EXPECT_EQ(metric(run->report, "makespan"), 6.0);
  const Table& rows = table_named(run->report, "rows");
  ASSERT_EQ(rows.rows.size(), 2U);
  EXPECT_EQ((TableRow{rows, rows.rows[0]}.get<std::vector<Vec2>>("path").size()), 7U);
  const auto& paths = run->log.messages<nav_msgs::Path>("/plan/cbs");
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_EQ(paths[0].message.poses.size(), 7U);
  EXPECT_EQ(paths[0].message.poses.back().header.stamp.sec, 6);
}

TEST_F(FleetJobTest, NoPlanIsAnAnswer) {
  const auto run = lead(passing(corridor));
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_EQ(run->report.status, "not_done");
  EXPECT_NE(run->report.reason.find("all that they can do was tried"), std::string::npos);
  const auto ended = lead(passing(corridor, {{"planner", "cbs"}, {"budget", "50"}}));
  ASSERT_TRUE(ended.has_value());
  EXPECT_EQ(ended->report.status, "not_done");
  EXPECT_NE(ended->report.reason.find("the budget ended after 50"), std::string::npos);
}

TEST_F(FleetJobTest, AgentsAreTheRowsOfAScenario) {
  const std::string rows = "version 1\n0\ta.map\t5\t2\t0\t1\t4\t1\t4\n0\ta.map\t5\t2\t4\t1\t0\t1\t4\n";
  const std::string map = folder_.write("a.map", bay), agents = folder_.write("a.scen", rows);
  const auto both = lead({{"map", map}, {"agents", agents}});
  ASSERT_TRUE(both.has_value()) << to_string(both.error());
  EXPECT_EQ(metric(both->report, "robots"), 2.0);
  const auto one = lead({{"map", map}, {"agents", agents}, {"robots", "1"}});
  ASSERT_TRUE(one.has_value());
  EXPECT_EQ(metric(one->report, "cost"), 4.0);
  EXPECT_NE(refusal({{"map", map}, {"agents", agents}, {"robots", "3"}})
                .find("robots: 3 robots are more than the 2"),
            std::string::npos);
  EXPECT_NE(
      refusal({{"map", map}, {"agents", agents}, {"starts", "1,1"}}).find("agents: it stands beside starts"),
      std::string::npos);
  const std::string other = folder_.write("b.scen", "version 1\n0\ta.map\t9\t9\t0\t1\t4\t1\t4\n");
  EXPECT_NE(refusal({{"map", map}, {"agents", other}}).find("for a map of 9 x 9 cells"), std::string::npos);
}

TEST_F(FleetJobTest, WhatDoesNotFitIsRefusedWithItsKey) {
  const auto says = [&](const Changes& changes, const std::string& words) {
    const std::string sentence = refusal(changes);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  const std::string map = folder_.write("a.map", bay);
  says({}, "map: it is missing");
  says({{"map", map}}, "starts: it is missing");
  says({{"map", map}, {"starts", "0.5,0.5"}, {"goals", "1.5,0.5 2.5,0.5"}},
       "goals: 2 goals came with 1 starts");
  says({{"map", map}, {"starts", "0.5"}, {"goals", "1.5,0.5"}}, "starts: ");
  says({{"map", map}, {"starts", "0.5,1.5"}, {"goals", "1.5,0.5"}},
       "robot 1: the start (0.5, 1.5) is blocked");
  says({{"map", map}, {"starts", "0.5,0.5 0.6,0.6"}, {"goals", "1.5,0.5 2.5,0.5"}}, "have the same start");
  says(passing(bay, {{"radius", "0.4"}}), "radius: robots of 0.4 m would touch each other");
  says(passing(bay, {{"planner", "a_star"}}), "planner");
  says({{"map", folder_.write("room.txt", "(0,0) (8,0) (8,6) (0,6)\n---\n---\n(1,1) (7,1)\n")}},
       "maps of cells");
}

}  // namespace
}  // namespace outrider
