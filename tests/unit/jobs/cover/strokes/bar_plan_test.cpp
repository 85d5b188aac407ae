#include "strokes/bar_plan.hpp"

#include <gtest/gtest.h>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/jobs/cover/report.hpp"
#include "outrider/log/topics.hpp"
#include "support/cover_areas.hpp"
#include "support/dense_bar.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// A yard with a house: a mower whose deck is ahead of it, behind it, or under it.
CoverProblem yard(double forward_m) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {20, 0}, {20, 12}, {0, 12}};
  problem.holes = {{{8, 5}, {11, 5}, {11, 7}, {8, 7}}};
  problem.width_m = 0.6;
  problem.tool = {"bar", 1.2, 0.3, forward_m};
  return problem;
}

CoverPlan bar_planned(const CoverProblem& problem) {
  auto plan = find_cover_method("quickest")->plan(problem, testing::any_order(), {});
  if (!plan) throw std::runtime_error(to_string(plan.error()));
  return std::move(*plan);
}

TEST(BarPlan, AYardIsDoneWithADeckAheadBehindAndUnder) {
  for (const double forward_m : {0.4, -0.5, 0.0, 0.1}) {
    const CoverProblem problem = yard(forward_m);
    const CoverPlan plan = bar_planned(problem);
    const auto proof = prove(plan, problem);
    ASSERT_TRUE(proof) << to_string(proof.error());
    EXPECT_TRUE(proof->complete) << forward_m << " m ahead: " << proof->planned.fraction;
    EXPECT_EQ(proof->length_bound_m, 0.0);
    EXPECT_LT(plan.sums.length_m, 1.3 * area_of(plan.ground.reach) / problem.stride_m());
  }
}

/// Random fields and bars, from the poses of the track alone: the judge and the twin agree on what is
/// covered, the bar and the robot stay within the area, and nothing is called complete that is not.
TEST(BarPlan, TheJudgeAgreesWithADenseRaster) {
  Rng rng(31);
  int complete = 0, incomplete = 0;
  for (int k = 0; k < testing::cases(2); ++k) {
    CoverProblem problem = testing::random_cover_problem(rng);
    problem.tracking_error_m = 0.0;
    problem.tool = {"bar", rng.uniform(0.5, 1.1), rng.uniform(0.05, 0.4), rng.uniform(-0.5, 0.5)};
    const Bar bar = problem.bar().value();
    const CoverPlan plan = bar_planned(problem);
    const auto proof = prove(plan, problem);
    ASSERT_TRUE(proof) << "case " << k << ": " << to_string(proof.error());
    const testing::DenseBar twin(cover::poses_along(plan.track.start, plan.track.pieces), bar, 0.05);
    for (const Pose2& pose : twin.poses()) {
      EXPECT_GE(plan.ground.ground->edge_distance(pose.position), problem.body_radius_m() - 1e-6);
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
          const Vec2 corner = pose * Vec2{bar.forward_m + x * bar.length_m, y * bar.width_m};
          EXPECT_TRUE(!plan.ground.ground->solid(corner) || plan.ground.ground->edge_distance(corner) < 2e-5)
              << "case " << k << ": the bar is outside at " << corner.x << ", " << corner.y;
        }
      }
    }
    const Box2 box = bounds_of(plan.ground.reach);
    const double cell = box.size().x / 60.0;
    double covered = 0.0, all = 0.0;
    for (double x = box.low.x + 0.5 * cell; x < box.high.x; x += cell) {
      for (double y = box.low.y + 0.5 * cell; y < box.high.y; y += cell) {
        if (!contains(plan.ground.reach, {x, y})) continue;
        all += 1.0;
        const bool under = twin.passes_over({x, y}, 0.015) > 0;
        covered += twin.passes_over({x, y}) > 0 ? 1.0 : 0.0;
        EXPECT_TRUE(under || !contains(proof->planned.covered, {x, y})) << "never under the bar; case " << k;
      }
    }
    EXPECT_NEAR(proof->planned.fraction, covered / all, 0.01) << "case " << k;
    EXPECT_TRUE(!proof->complete || covered / all > 1.0 - problem.uncovered - 0.004) << "case " << k;
    double missed_m2 = 0.0;
    for (const MissedPlace& place : proof->missed) missed_m2 += place.area_m2;
    EXPECT_LE(missed_m2, proof->planned.missed_m2 + 1e-6);
    EXPECT_EQ(proof->missed.empty(), proof->complete);
    ++(proof->complete ? complete : incomplete);
  }
  EXPECT_GT(complete + incomplete, 0);
}

TEST(BarPlan, TheDriveCoversWhatWasProven) {
  const CoverProblem problem = yard(0.4);
  CoverRun run;
  run.plan = bar_planned(problem);
  run.proof = prove(run.plan, problem).value();
  run.drive = drive_track(run.plan.track, *run.plan.ground.ground, problem.pace, 0.0, 3);
  run.driven = cover::coverage_of_drive(run.drive, problem, run.plan.ground.reach);
  EXPECT_NEAR(run.driven.covered_m2, run.proof.planned.covered_m2, 1e-3);
  Log log;
  CoverLog logged(log, problem, run.plan, 3, "yard");
  logged.note(run.drive);
  logged.finish(run.drive, run.driven);
  const auto& rows = log.messages<outrider_msgs::Coverage>(topic::coverage);
  EXPECT_NEAR(rows.back().message.covered, run.driven.covered_m2, 1e-3 * run.driven.covered_m2);
  EXPECT_NEAR(rows.back().message.overlap, run.driven.overlap_m2, 0.02 * run.driven.covered_m2);
}

/// A boom across a tractor: turns with a radius, and a bar that is wider than the robot.
TEST(BarPlan, ARobotWithATurningRadiusCarriesABoom) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};
  problem.width_m = 2.0;
  problem.tool = {"bar", 6.0, 0.3, 0.0};
  problem.turning_radius_m = 3.0;
  problem.reverse = true;
  const CoverPlan plan = bar_planned(problem);
  const auto proof = prove(plan, problem);
  ASSERT_TRUE(proof) << to_string(proof.error());
  EXPECT_EQ(plan.sums.stops, 0U);
  EXPECT_GT(proof->planned.fraction, 0.97);
  EXPECT_EQ(proof->missed.empty(), proof->complete);
}

TEST(BarPlan, TheJudgeRefusesABarThatLeavesTheArea) {
  const CoverProblem problem = yard(0.4);
  const CoverPlan plan = bar_planned(problem);
  CoverProblem wider = problem;
  wider.tool.width_m = 1.25;
  const auto proof = prove(plan, wider);
  ASSERT_FALSE(proof);
  EXPECT_NE(proof.error().sentence.find("the bar leaves the area"), std::string::npos);
}

void expect_no_bar(const CoverProblem& problem, const std::string& where, const std::string& says,
                   const char* method = "quickest") {
  const auto plan = find_cover_method(method)->plan(problem, {}, {});
  ASSERT_FALSE(plan) << says;
  EXPECT_EQ(plan.error().where, where);
  EXPECT_NE(plan.error().sentence.find(says), std::string::npos) << plan.error().sentence;
}

TEST(BarPlan, BadInputIsRefusedInASentence) {
  const auto with = [](auto change) {
    CoverProblem problem = yard(0.4);
    change(problem);
    return problem;
  };
  expect_no_bar(with([](auto& p) { p.tool.shape = "ring"; }), "tool.shape", "give disk or bar");
  expect_no_bar(with([](auto& p) { p.tool.width_m = -1.0; }), "tool.width", "0 for the width of the robot");
  expect_no_bar(with([](auto& p) { p.tool.length_m = 0.0; }), "tool.length", "give 0.0012 to 120 m");
  expect_no_bar(with([](auto& p) { p.tool.forward_m = 1e6; }), "tool.forward", "give at most");
  expect_no_bar(with([](auto& p) { p.tracking_error_m = 0.01; }), "tracking_error", "nothing is proven");
  expect_no_bar(with([](auto& p) { p.transfers = true; }), "transfers", "for disks only");
  expect_no_bar(with([](auto& p) { p.tool.width_m = 20.0; }), "tool.width", "fits nowhere");
  expect_no_bar(yard(0.4), "method", "take 'boustrophedon'", "spiral");
}

}  // namespace
}  // namespace outrider
