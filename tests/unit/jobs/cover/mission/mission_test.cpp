#include "outrider/jobs/cover/mission/mission.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "outrider/jobs/cover/bounds/time_bound.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

CoverProblem room() {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {1.5, 0}, {1.5, 1.5}, {0, 1.5}};
  problem.overlap = 1.0 - 1.0 / 1.1;
  problem.tracking_error_m = 0.009;
  return problem;
}

TEST(CoverDrive, TheRoomIsCoveredWithinItsBoundsBySlowAndFastDrives) {
  const CoverProblem problem = room();
  const auto plan = find_cover_method("quickest")->plan(problem, {}, {});
  ASSERT_TRUE(plan);
  const auto proof = prove(*plan, problem);
  ASSERT_TRUE(proof);
  const TimeBound bound = time_bound(plan->track, problem.pace, problem.tracking_error_m, 1.0);
  for (int seed = 1; seed <= testing::cases(10); ++seed) {
    const PieceDrive drive = drive_track(plan->track, *plan->ground.ground, problem.pace,
                                         problem.tracking_error_m, static_cast<std::uint64_t>(seed));
    EXPECT_LT(drive.time_s, 176.0) << "the reference takes 176 s";
    EXPECT_GE(drive.time_s, bound.least_s);
    EXPECT_LE(drive.time_s, bound.most_s);
    EXPECT_GT(drive.tracking_error_m, 0.0);
    EXPECT_LE(drive.tracking_error_m, problem.tracking_error_m);
    const Coverage driven = coverage_of(drive.way, problem.radius_m(), plan->ground.reach);
    EXPECT_GE(driven.fraction, proof->sure_fraction - 1e-4);
    for (const Vec2 p : drive.way) EXPECT_TRUE(plan->ground.ground->point_free(p));
  }
}

TEST(CoverDrive, FollowsTheTrackExactlyWithoutTrackingError) {
  CoverProblem problem = room();
  problem.pace.slowest_speed_mps = problem.pace.speed_mps;
  problem.pace.slowest_turn_rate_radps = problem.pace.turn_rate_radps;
  const auto plan = find_cover_method("boustrophedon")->plan(problem, testing::any_order(), {});
  ASSERT_TRUE(plan);
  const PieceDrive drive = drive_track(plan->track, *plan->ground.ground, problem.pace, 0.0, 1);
  EXPECT_NEAR(drive.time_s, plan->sums.time_s, 1e-6);
  EXPECT_NEAR(drive.length_m, plan->sums.length_m, 1e-9);
  EXPECT_NEAR(drive.turned_rad, plan->sums.turned_rad, 1e-6);
  EXPECT_EQ(drive.tracking_error_m, 0.0);
}

TEST(CoverDrive, RandomAreasStayWithinBounds) {
  Rng rng(29);
  for (int k = 0; k < testing::cases(3); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const auto plan = find_cover_method("boustrophedon")->plan(problem, testing::any_order(), {});
    ASSERT_TRUE(plan) << k;
    const auto proof = prove(*plan, problem);
    ASSERT_TRUE(proof) << k;
    const TimeBound bound = time_bound(plan->track, problem.pace, problem.tracking_error_m, 1.0);
    const PieceDrive drive =
        drive_track(plan->track, *plan->ground.ground, problem.pace, problem.tracking_error_m, rng.bits());
    EXPECT_GE(drive.time_s, bound.least_s) << k;
    EXPECT_LE(drive.time_s, bound.most_s) << k;
    const double fraction = coverage_of(drive.way, problem.radius_m(), plan->ground.reach).fraction;
    EXPECT_GE(fraction, proof->sure_fraction - 1e-3) << k;
    for (const Vec2 p : drive.way) EXPECT_TRUE(plan->ground.ground->point_free(p)) << k;
  }
}

TEST(CoverDrive, SameSeedSameDrive) {
  const CoverProblem problem = room();
  const auto plan = find_cover_method("boustrophedon")->plan(problem, testing::any_order(), {});
  ASSERT_TRUE(plan);
  const auto drive = [&](std::uint64_t seed) {
    return drive_track(plan->track, *plan->ground.ground, problem.pace, problem.tracking_error_m, seed);
  };
  EXPECT_EQ(drive(4).way, drive(4).way);
  EXPECT_EQ(drive(4).time_s, drive(4).time_s);
  EXPECT_NE(drive(4).way, drive(5).way);
}

TEST(CoverMission, GivesPieceAfterPieceAndPausesWhereTheTrackTurns) {
  const CoverTrack track{{{0, 0}, 0.0},
                         {{{0, 0}, {1, 0}, {}, 0.0}, {{1, 0}, {2, 0}, {}, 0.0}, {{2, 0}, {2, 1}, {}, 0.0}}};
  CoverMission mission(track, 1.5);
  std::vector<FollowPiece> given;
  while (const auto command = mission.step({})) given.push_back(std::get<FollowPiece>(*command));
  ASSERT_EQ(given.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(given[i].piece, track.pieces[i]);
  EXPECT_EQ(given[0].next, track.pieces[1]);
  EXPECT_EQ(given[2].next, std::nullopt);
  EXPECT_EQ(given[0].pause_s, 0.0);
  EXPECT_EQ(given[1].pause_s, 0.0);
  EXPECT_EQ(given[2].pause_s, 1.5);
}

TEST(CoverDrive, AStopLeavesThePiecesDrivenUntilThen) {
  const CoverProblem problem = room();
  const auto plan = find_cover_method("boustrophedon")->plan(problem, testing::any_order(), {});
  ASSERT_TRUE(plan);
  std::stop_source source;
  RunWatch watch;
  watch.stop = source.get_token();
  int told = 0;
  watch.progress = [&](const RunStep& step) {
    EXPECT_LT(step.part, 1.0);
    if (++told == 4) source.request_stop();
  };
  const auto drive = [&](const RunWatch& by) {
    return drive_track(plan->track, *plan->ground.ground, problem.pace, problem.tracking_error_m, 1, by);
  };
  const PieceDrive part = drive(watch), whole = drive({});
  ASSERT_EQ(part.ends_s.size(), 3U);
  EXPECT_EQ(part.time_s, whole.ends_s[2]);
  EXPECT_TRUE(std::ranges::equal(part.way, std::span(whole.way).first(part.way.size())));
}

}  // namespace
}  // namespace outrider
