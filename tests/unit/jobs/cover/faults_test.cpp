// Covering with faults that the robot is not told: done only if what was promised is truly covered, and no
// contact with the map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "outrider/core/units.hpp"
#include "outrider/job/plan_cache.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/cover/job.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/cover_areas.hpp"
#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

class CoverFaults : public ::testing::Test {
 protected:
  /// A yard of 10 x 6 m with a box in it and a robot 0.8 m wide.
  [[nodiscard]] Changes yard(const Changes& more) const {
    Changes changes{
        {"area", folder_.write("yard.txt", "(0,0) (10,0) (10,6) (0,6)\n---\n(6,2) (7,2) (7,3.5) (6,3.5)\n")},
        {"width", "0.8"},
        {"tracking_error", "0.03"},
        {"pace.speed", "0.5"},
        {"pace.slowest_speed", "0.4"}};
    changes.insert(changes.end(), more.begin(), more.end());
    return changes;
  }
  [[nodiscard]] Outcome<outrider::Run> tried(const Changes& changes) const {
    const Job job = cover_job();
    const auto task = job.blank();
    if (auto ok = change(*task, changes); !ok) return pass_on(ok);
    return run_task(job, *task, {.plans = &plans_});
  }
  /// Runs it, and holds the report to what the log and geometry say.
  [[nodiscard]] outrider::Run covered(const Changes& more) const {
    auto run = tried(yard(more));
    if (!run) throw std::runtime_error(to_string(run.error()));
    const Report& report = run->report;
    EXPECT_EQ(report.reason.empty(), report.status == "done") << report.reason;
    if (more.empty()) return std::move(*run);
    EXPECT_EQ(metric(report, "contacts"), 0.0);
    EXPECT_EQ(metric(report, "false_covered"), 0.0);
    EXPECT_EQ(metric(report, "held_up"), static_cast<double>(events_of(run->log, "held_up").size()));
    const double share = metric(report, "promised_missed_m2") / metric(report, "reach_m2");
    EXPECT_EQ(report.status == "done", share <= 1e-3);
    return std::move(*run);
  }
  test::Folder folder_;
  mutable PlanCache plans_;  ///< faults do not change the plan
};

/// Whoever runs a task before its area is read has a bug, and is told so.
TEST_F(CoverFaults, ATaskThatWasNotLoadedDoesNotRun) {
  outrider::Run run;
  EXPECT_THROW(static_cast<void>(CoverJob().run(run, {})), std::logic_error);
}

TEST_F(CoverFaults, WithoutAnyNothingIsAdded) {
  const outrider::Run run = covered({});
  EXPECT_EQ(run.report.status, "done");
  EXPECT_FALSE(std::isfinite(metric(run.report, "held_up")));
}

TEST_F(CoverFaults, FaultsThatComeAfterTheEndChangeNothing) {
  const outrider::Run whole = covered({});
  const outrider::Run late = covered({{"faults.stuck_from", "100000"}, {"faults.kidnapped_at", "100000"}});
  EXPECT_EQ(metric(late.report, "held_up"), 0.0);
  for (const auto& [name, value] : whole.report.metrics) {
    EXPECT_NEAR(metric(late.report, name), value, 1e-9 * std::abs(value) + 1e-9) << name;
  }
}

TEST_F(CoverFaults, WheelsThatStickForAWhileAreWaitedFor) {
  const double whole_s = metric(covered({}).report, "time_s");
  for (const char* at : {"0", "71.3"}) {
    const outrider::Run run = covered({{"faults.stuck_from", at}, {"faults.stuck_for", "30"}});
    EXPECT_EQ(run.report.status, "done") << at << ": " << run.report.reason;
    EXPECT_GE(metric(run.report, "held_up"), 2.0);
    EXPECT_GT(metric(run.report, "time_s"), whole_s + 25.0);
  }
}

TEST_F(CoverFaults, WheelsThatStickForGoodAreNotDone) {
  const outrider::Run run = covered({{"faults.stuck_from", "60"}});
  EXPECT_EQ(run.report.status, "not_done");
  EXPECT_NE(run.report.reason.find("does not get on any more"), std::string::npos) << run.report.reason;
  EXPECT_GT(metric(run.report, "left_out_m"), 10.0);
  EXPECT_LT(metric(run.report, "time_s"), 200.0) << "it gives up";
}

TEST_F(CoverFaults, ARobotThatIsPutElsewhereDrivesBack) {
  const double whole_m = metric(covered({}).report, "length_m");
  for (const auto& [at, by] : {std::pair{"3", "2.5"}, {"90.5", "-3"}}) {
    const outrider::Run run =
        covered({{"faults.kidnapped_at", at}, {"faults.kidnapped_by", by}, {"faults.kidnapped_turn", "130"}});
    EXPECT_EQ(run.report.status, "done") << at << ": " << run.report.reason;
    EXPECT_EQ(metric(run.report, "held_up"), 1.0);
    EXPECT_EQ(metric(run.report, "left_out_m"), 0.0);
    EXPECT_GT(metric(run.report, "length_m"), whole_m);
  }
}

/// The jump is no drive: the track has a gap there that no robot drives, and nothing in it counts as covered.
TEST_F(CoverFaults, BeingCarriedCoversNothing) {
  const outrider::Run run = covered({{"faults.kidnapped_at", "40"}, {"faults.kidnapped_by", "3"}});
  const auto& rows = run.log.messages<outrider_msgs::Coverage>(topic::coverage);
  EXPECT_NEAR(rows.back().message.covered, metric(run.report, "covered_m2"),
              2e-3 * metric(run.report, "reach_m2"));
}

TEST_F(CoverFaults, APostThatStaysIsDrivenAround) {
  for (const char* at : {"5", "57", "100"}) {
    const outrider::Run run =
        covered({{"faults.blocked_at", at}, {"faults.blocked_radius", "0.1"}, {"seed", at}});
    EXPECT_LT(metric(run.report, "left_out_m"), 6.0) << at;
    EXPECT_GE(metric(run.report, "post_contacts"), 2.0) << "it stands there";
    const double post_m2 = pi * 0.1 * 0.1;
    EXPECT_GT(metric(run.report, "promised_missed_m2"), 0.9 * post_m2);
    EXPECT_LT(metric(run.report, "promised_missed_m2"), post_m2 + 0.6) << run.report.reason;
    EXPECT_GT(metric(run.report, "left_out_m"), 0.0);
  }
}

TEST_F(CoverFaults, APostThatHidesMuchIsNotDone) {
  const outrider::Run run = covered({{"faults.blocked_at", "50"}, {"faults.blocked_radius", "0.5"}});
  EXPECT_EQ(run.report.status, "not_done");
  EXPECT_GE(metric(run.report, "promised_missed_m2"), 0.9 * pi * 0.25);
  EXPECT_LT(metric(run.report, "promised_missed_m2"), pi * 0.25 + 1.5) << "it drives around it";
  EXPECT_NE(run.report.reason.find("touched something that is not on the map"), std::string::npos);
}

TEST_F(CoverFaults, APostThatIsTakenAwayIsNoLoss) {
  for (const char* stays : {"9", "18", "60"}) {
    const outrider::Run run = covered({{"faults.blocked_at", "50"}, {"faults.blocked_for", stays}});
    EXPECT_GE(metric(run.report, "post_contacts"), 1.0);
    EXPECT_EQ(run.report.status, "done") << stays << ": " << run.report.reason;
  }
}

/// Its wheels stick while it touches the post: that is no news about the post.
TEST_F(CoverFaults, ARobotThatSticksBesideAPostWaits) {
  const Changes post{
      {"faults.blocked_at", "50"}, {"faults.blocked_for", "60"}, {"faults.blocked_radius", "0.1"}};
  const outrider::Run alone = covered(post);
  const double touched_s = events_of(alone.log, "held_up").front().time_s();
  Changes both = post;
  both.push_back({"faults.stuck_from", std::to_string(touched_s + 5.0)});
  both.push_back({"faults.stuck_for", "40"});
  const outrider::Run run = covered(both);
  EXPECT_EQ(run.report.status, "done") << run.report.reason;
  EXPECT_GE(metric(run.report, "held_up"), 4.0);
}

TEST_F(CoverFaults, WheelsThatSlipEndShortAndGoOn) {
  for (const char* slip : {"0.05", "0.5", "0.9"}) {
    const outrider::Run run = covered({{"faults.slip", slip}});
    EXPECT_EQ(run.report.status, "done") << slip << ": " << run.report.reason;
    EXPECT_GT(metric(run.report, "held_up"), 10.0);
  }
}

TEST_F(CoverFaults, ALargerTrackingErrorThanToldIsNoticed) {
  const outrider::Run run = covered({{"faults.tracking", "6"}});
  EXPECT_GT(metric(run.report, "strayed_m"), 0.03);
  EXPECT_EQ(run.report.status, "not_done");
  EXPECT_NE(run.report.reason.find("more than the tracking_error of 0.03 m"), std::string::npos)
      << run.report.reason;
}

TEST_F(CoverFaults, SameSeedSameBytes) {
  const Changes faults{{"faults.kidnapped_at", "30"}, {"faults.stuck_from", "70"}, {"faults.stuck_for", "5"},
                       {"faults.blocked_at", "90"},   {"faults.slip", "0.1"},      {"seed", "5"}};
  const outrider::Run one = covered(faults), other = covered(faults);
  EXPECT_EQ(one.report.metrics, other.report.metrics);
  EXPECT_GE(metric(one.report, "post_contacts"), 1.0);
  EXPECT_GE(metric(one.report, "held_up"), 4.0);
}

TEST_F(CoverFaults, ARobotThatSteersIsHeldUpToo) {
  const Changes steers{{"turning_radius", "0.5"}, {"reverse", "true"}};
  const auto with = [&](Changes more) {
    more.insert(more.begin(), steers.begin(), steers.end());
    return covered(more);
  };
  const outrider::Run stuck = with({{"faults.stuck_from", "30"}, {"faults.stuck_for", "8"}});
  EXPECT_EQ(stuck.report.status, "done") << stuck.report.reason;
  EXPECT_GE(metric(stuck.report, "held_up"), 1.0);
  const outrider::Run carried = with({{"faults.kidnapped_at", "60"}, {"faults.kidnapped_by", "1.5"}});
  EXPECT_EQ(carried.report.status, "done") << carried.report.reason;
  EXPECT_GE(metric(carried.report, "held_up"), 1.0);
}

TEST_F(CoverFaults, WhatCannotBeSimulatedIsRefused) {
  const auto refusal = [&](const Changes& more) {
    const auto run = tried(yard(more));
    return run ? std::string("taken") : to_string(run.error());
  };
  EXPECT_NE(
      refusal({{"tool.shape", "bar"}, {"tracking_error", "0"}, {"faults.slip", "0.1"}}).find("faults: "),
      std::string::npos);
  EXPECT_NE(refusal({{"tracking_error", "0"}, {"faults.tracking", "2"}}).find("faults.tracking: 2 times"),
            std::string::npos);
}

/// A robot that is not held up is sent where CoverMission sends it.
TEST(CoverRecovery, DrivesAsTheMissionWithoutRecovery) {
  Rng rng(31);
  for (int k = 0; k < testing::cases(3); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const auto plan = find_cover_method("boustrophedon")->plan(problem, {}, {});
    ASSERT_TRUE(plan) << k;
    const auto seed = rng.bits();
    const PieceDrive plain =
        drive_track(plan->track, *plan->ground.ground, problem.pace, problem.tracking_error_m, seed);
    const FaultyDrive same = drive_with_faults(plan->track, problem, plan->ground.ground, {}, seed);
    EXPECT_EQ(same.drive.way, plain.way) << k;
    EXPECT_EQ(same.drive.times_s, plain.times_s) << k;
    EXPECT_TRUE(same.mission.hold_ups.empty());
    EXPECT_TRUE(same.mission.believes_complete());
    EXPECT_TRUE(same.finished);
  }
}

}  // namespace
}  // namespace outrider
