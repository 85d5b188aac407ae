#include "outrider/jobs/cover/drive.hpp"

#include <gtest/gtest.h>

#include "outrider/jobs/cover/time_bound.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

CoverProblem room() {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {1.5, 0}, {1.5, 1.5}, {0, 1.5}};
  problem.overlap = 1.0 - 1.0 / 1.1;
  problem.stray_m = 0.009;
  return problem;
}

TEST(CoverDrive, TheRoomIsCoveredWithinItsBoundsBySlowAndFastDrives) {
  const CoverProblem problem = room();
  const auto plan = find_cover_method("quickest")->plan(problem, {}, {});
  ASSERT_TRUE(plan);
  const auto proof = prove(*plan, problem);
  ASSERT_TRUE(proof);
  const TimeBound bound = time_bound(plan->track, problem.pace, problem.stray_m, 1.0);
  for (int seed = 1; seed <= testing::cases(10); ++seed) {
    const CoverDrive drive = drive_track(plan->track, *plan->ground.ground, problem.pace, problem.stray_m,
                                         static_cast<std::uint64_t>(seed));
    EXPECT_LT(drive.time_s, 176.0) << "the reference takes 176 s";
    EXPECT_GE(drive.time_s, bound.least_s);
    EXPECT_LE(drive.time_s, bound.most_s);
    EXPECT_GT(drive.strayed_m, 0.0);
    EXPECT_LE(drive.strayed_m, problem.stray_m);
    const Coverage driven = coverage_of(drive.way, problem.radius_m(), plan->ground.reach);
    EXPECT_GE(driven.fraction, proof->sure_fraction - 1e-4);
    for (const Vec2 p : drive.way) EXPECT_TRUE(plan->ground.ground->point_free(p));
  }
}

TEST(CoverDrive, ExactlyTheTrackWithoutAStray) {
  CoverProblem problem = room();
  problem.pace.slowest_speed_mps = problem.pace.speed_mps;
  problem.pace.slowest_turn_rate_radps = problem.pace.turn_rate_radps;
  const auto plan = find_cover_method("boustrophedon")->plan(problem, {}, {});
  ASSERT_TRUE(plan);
  const CoverDrive drive = drive_track(plan->track, *plan->ground.ground, problem.pace, 0.0, 1);
  EXPECT_NEAR(drive.time_s, plan->sums.time_s, 1e-6);
  EXPECT_NEAR(drive.length_m, plan->sums.length_m, 1e-9);
  EXPECT_NEAR(drive.turned_rad, plan->sums.turned_rad, 1e-6);
  EXPECT_EQ(drive.strayed_m, 0.0);
}

TEST(CoverDrive, RandomAreasStayWithinBounds) {
  Rng rng(29);
  for (int k = 0; k < testing::cases(3); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const auto plan = find_cover_method("boustrophedon")->plan(problem, {}, {});
    ASSERT_TRUE(plan) << k;
    const auto proof = prove(*plan, problem);
    ASSERT_TRUE(proof) << k;
    const TimeBound bound = time_bound(plan->track, problem.pace, problem.stray_m, 1.0);
    const CoverDrive drive =
        drive_track(plan->track, *plan->ground.ground, problem.pace, problem.stray_m, rng.bits());
    EXPECT_GE(drive.time_s, bound.least_s) << k;
    EXPECT_LE(drive.time_s, bound.most_s) << k;
    const double fraction = coverage_of(drive.way, problem.radius_m(), plan->ground.reach).fraction;
    EXPECT_GE(fraction, proof->sure_fraction - 1e-3) << k;
    for (const Vec2 p : drive.way) EXPECT_TRUE(plan->ground.ground->point_free(p)) << k;
  }
}

TEST(CoverDrive, SameSeedSameDrive) {
  const CoverProblem problem = room();
  const auto plan = find_cover_method("boustrophedon")->plan(problem, {}, {});
  ASSERT_TRUE(plan);
  const auto drive = [&](std::uint64_t seed) {
    return drive_track(plan->track, *plan->ground.ground, problem.pace, problem.stray_m, seed);
  };
  EXPECT_EQ(drive(4).way, drive(4).way);
  EXPECT_EQ(drive(4).time_s, drive(4).time_s);
  EXPECT_NE(drive(4).way, drive(5).way);
}

}  // namespace
}  // namespace outrider
