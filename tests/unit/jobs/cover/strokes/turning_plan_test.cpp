#include "strokes/turning_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/bounds/time_bound.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

CoverProblem field(double width_m, double height_m, double turning_radius_m, bool reverse) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}};
  problem.width_m = 2.0;
  problem.turning_radius_m = turning_radius_m;
  problem.reverse = reverse;
  problem.pace.speed_mps = 1.5;
  problem.pace.slowest_speed_mps = 1.0;
  return problem;
}

CoverPlan planned(const CoverProblem& problem) {
  auto plan = find_cover_method("boustrophedon")->plan(problem, testing::any_order(), {});
  if (!plan) throw std::runtime_error(to_string(plan.error()));
  return std::move(*plan);
}

/// From dense points of the track alone: the radius through three of them, and whether the direction turns
/// about.
struct Shape {
  double least_radius_m = std::numeric_limits<double>::infinity();
  int cusps = 0;
};

Shape shape_of(const CoverPlan& plan) {
  Shape shape;
  const auto way = points_along(plan.track.start.position, plan.track.pieces, radians(0.5));
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const Vec2 in = way[i] - way[i - 1], out = way[i + 1] - way[i];
    const double turn = std::abs(std::atan2(cross(in, out), dot(in, out)));
    if (turn > 0.5 * pi) {
      ++shape.cusps;
    } else if (turn > 1e-5) {
      // The circle through three points: chords of a true arc lie on it, and beside a tangent it is larger.
      const double radius = norm(in) * norm(out) * norm(in + out) / (2.0 * std::abs(cross(in, out)));
      shape.least_radius_m = std::min(shape.least_radius_m, radius);
    }
  }
  return shape;
}

TEST(TurningPlan, ARectangleIsCoveredButForItsCorners) {
  const CoverProblem problem = field(28, 18, 3.0, false);
  const CoverPlan plan = planned(problem);
  const auto proof = prove(plan, problem);
  ASSERT_TRUE(proof) << to_string(proof.error());
  EXPECT_EQ(plan.sums.stops, 0U);
  const Shape shape = shape_of(plan);
  EXPECT_GE(shape.least_radius_m, 3.0 * (1.0 - 1e-6));
  EXPECT_EQ(shape.cusps, 0);
  // Known: in a right corner a disk of r that rounds it with R leaves the corner of a disk of R + r, less the
  // one that is out of its reach anyway.
  EXPECT_FALSE(proof->complete);
  ASSERT_EQ(proof->missed.size(), 4U);
  for (const MissedPlace& place : proof->missed) {
    EXPECT_NEAR(place.area_m2, (1.0 - 0.25 * pi) * (16.0 - 1.0), 0.01);
    const Vec2 off{std::min(place.at.x, 28.0 - place.at.x), std::min(place.at.y, 18.0 - place.at.y)};
    EXPECT_LT(norm(off), 1.5);
  }
}

TEST(TurningPlan, WithReverseNothingIsLeft) {
  const CoverProblem problem = field(28, 18, 3.0, true);
  const CoverPlan plan = planned(problem);
  const auto proof = prove(plan, problem);
  ASSERT_TRUE(proof) << to_string(proof.error());
  EXPECT_TRUE(proof->complete);
  EXPECT_TRUE(proof->missed.empty());
  EXPECT_GE(proof->planned.fraction, 0.9995);
  EXPECT_EQ(plan.sums.stops, 0U);
  const Shape shape = shape_of(plan);
  EXPECT_GT(shape.cusps, 0);
  EXPECT_GE(shape.least_radius_m, 3.0 * (1.0 - 1e-6));
  EXPECT_LT(plan.sums.length_m, planned(field(28, 18, 3.0, false)).sums.length_m) << "and it takes less";
}

TEST(TurningPlan, AnAreaThatMayStayUncoveredIsDone) {
  CoverProblem problem = field(28, 18, 3.0, false);
  problem.uncovered = 0.026;
  const auto proof = prove(planned(problem), problem);
  ASSERT_TRUE(proof);
  EXPECT_TRUE(proof->complete);
}

/// Random areas with holes: whatever is planned is driven by the robot, stays inside and covers what a raster
/// counts.
TEST(TurningPlan, RandomAreasAgainstARaster) {
  Rng rng(41);
  for (int k = 0; k < testing::cases(1); ++k) {
    CoverProblem problem = testing::random_cover_problem(rng);
    problem.turning_radius_m = rng.uniform(0.2, 1.2);
    problem.reverse = rng.below(2) == 0;
    const CoverPlan plan = planned(problem);
    const auto proof = prove(plan, problem);
    ASSERT_TRUE(proof) << k << ": " << to_string(proof.error());
    const Shape shape = shape_of(plan);
    EXPECT_GE(shape.least_radius_m, problem.turning_radius_m * (1.0 - 1e-4)) << k;
    EXPECT_TRUE(problem.reverse || shape.cusps == 0) << k;
    const auto way = points_along(plan.track.start.position, plan.track.pieces, radians(2.0));
    const double cell = 0.15 * problem.width_m;
    double reach = 0.0, covered = 0.0;
    for (double x = -6.0; x < 6.0; x += cell) {
      for (double y = -6.0; y < 6.0; y += cell) {
        if (!contains(plan.ground.reach, {x, y})) continue;
        reach += 1.0;
        covered += testing::passes_over({x, y}, way, problem.radius_m()) >= 1 ? 1.0 : 0.0;
      }
    }
    EXPECT_NEAR(proof->planned.fraction, covered / reach, 0.01) << k;
    double left_m2 = 0.0;
    for (const MissedPlace& place : proof->missed) left_m2 += place.area_m2;
    const double inner_m2 = proof->fields.front().inner_m2;
    const double out_m2 = problem.uncovered * area_of(plan.ground.reach);
    if (proof->complete) {
      EXPECT_GE(proof->inner_fraction, 1.0 - out_m2 / inner_m2 - 2e-4) << k;
    } else {
      EXPECT_GT(left_m2, out_m2) << k;
    }
  }
}

TEST(TurningPlan, TheDriveKeepsItsBounds) {
  CoverProblem problem = field(30, 20, 2.5, true);
  problem.tracking_error_m = 0.05;
  const CoverPlan plan = planned(problem);
  const auto proof = prove(plan, problem);
  ASSERT_TRUE(proof) << to_string(proof.error());
  const TimeBound bound = time_bound(plan.track, problem.pace, problem.tracking_error_m, 1.0);
  const PieceDrive drive =
      drive_track(plan.track, *plan.ground.ground, problem.pace, problem.tracking_error_m, 5);
  EXPECT_GE(drive.time_s, bound.least_s);
  EXPECT_LE(drive.time_s, bound.most_s);
  EXPECT_GE(coverage_of(drive.way, problem.radius_m(), plan.ground.reach).fraction,
            proof->sure_fraction - 1e-3);
  // Without an error it looks where it goes, or exactly the other way.
  const PieceDrive exact = drive_track(plan.track, *plan.ground.ground, problem.pace, 0.0, 5);
  int backwards = 0;
  for (std::size_t i = 1; i < exact.track.size(); ++i) {
    const TimedPose &a = exact.track[i - 1], &b = exact.track[i];
    const Vec2 went = b.pose.position - a.pose.position;
    if (norm(went) < 1e-6) continue;
    const double off = wrap_angle(heading_of(went) - 0.5 * (a.pose.heading_rad + b.pose.heading_rad));
    if (std::abs(off) > 0.5 * pi) ++backwards;
    EXPECT_LT(std::min(std::abs(off), std::abs(pi - std::abs(off))), radians(1.5)) << a.time_s;
  }
  EXPECT_GT(backwards, 0);
}

TEST(TurningPlan, BeginsAtTheStart) {
  CoverProblem problem = field(30, 20, 2.0, false);
  problem.start = Pose2{{10.0, 10.0}, 0.7};
  const CoverPlan plan = planned(problem);
  EXPECT_EQ(plan.track.start, *problem.start);
  EXPECT_TRUE(prove(plan, problem));
  EXPECT_EQ(plan.sums.stops, 0U);
  problem.start = Pose2{{29.0, 10.0}, 0.0};  // its nose at the wall
  const auto stuck = find_cover_method("boustrophedon")->plan(problem, {}, {});
  ASSERT_FALSE(stuck);
  EXPECT_EQ(stuck.error().code, FaultCode::start_blocked);
}

TEST(TurningPlan, SameProblemSameTrack) {
  const CoverProblem problem = field(30, 20, 2.0, true);
  EXPECT_EQ(planned(problem).track.pieces, planned(problem).track.pieces);
}

/// Corridors of 1 m, too narrow for any rounded lap: lanes lead to lanes.
TEST(TurningPlan, ARingOfCorridorsIsDriven) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  problem.holes = {{{1, 1}, {9, 1}, {9, 9}, {1, 9}}};
  problem.width_m = 0.6;
  problem.turning_radius_m = 0.5;
  const CoverPlan plan = planned(problem);
  const auto proof = prove(plan, problem);
  ASSERT_TRUE(proof) << to_string(proof.error());
  EXPECT_GT(proof->planned.fraction, 0.97);
  EXPECT_FALSE(proof->complete) << "the outer corners are too sharp";
}

TEST(TurningPlan, AHeadlandOfThatManyLaps) {
  CoverProblem problem = field(40, 25, 2.0, false);
  problem.headland = 3;
  EXPECT_EQ(planned(problem).laps, 3U);
}

TEST(TurningPlan, TheJudgeRefusesWhatTheRobotCannotDrive) {
  const CoverProblem problem = field(30, 20, 2.0, true);
  const CoverPlan plan = planned(problem);
  ASSERT_TRUE(prove(plan, problem));
  CoverProblem tighter = problem;
  tighter.turning_radius_m = 2.1;
  EXPECT_FALSE(prove(plan, tighter));
  CoverProblem forwards = problem;
  forwards.reverse = false;
  EXPECT_FALSE(prove(plan, forwards));
  CoverPlan flipped = plan;
  flipped.track.pieces[3].backward = !flipped.track.pieces[3].backward;
  EXPECT_FALSE(prove(flipped, problem));
  CoverPlan askew = plan;
  askew.track.start.heading_rad += 0.01;
  EXPECT_FALSE(prove(askew, problem));
  CoverProblem pivot = problem;  // the track of a robot that turns in place
  pivot.turning_radius_m = 0.0;
  pivot.reverse = false;
  EXPECT_FALSE(prove(planned(pivot), problem));
}

void expect_turning_refused(const CoverProblem& problem, const std::string& where, const std::string& says) {
  const auto plan = find_cover_method("quickest")->plan(problem, {}, {});
  ASSERT_FALSE(plan) << says;
  EXPECT_EQ(plan.error().where, where);
  EXPECT_NE(plan.error().sentence.find(says), std::string::npos) << plan.error().sentence;
}

TEST(TurningPlan, BadInputIsRefusedInASentence) {
  for (const double radius : {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e-9})
    expect_turning_refused(field(30, 20, radius, false), "turning_radius",
                           "or 0 for a robot that turns in place");
  expect_turning_refused(field(3, 3, 100.0, false), "turning_radius", "give a smaller radius");
  expect_turning_refused(field(30, 20, 0.0, true), "reverse", "for a robot with a turning radius");
  CoverProblem headland = field(30, 20, 0.0, false);
  headland.headland = 2;
  expect_turning_refused(headland, "headland", "for a robot with a turning radius");
  headland.turning_radius_m = 1.0;
  headland.headland = -1;
  expect_turning_refused(headland, "headland", "give 1 to 1000");
  CoverProblem apart = field(30, 20, 2.0, false);
  apart.transfers = true;
  apart.others = {{{{40, 0}, {60, 0}, {60, 20}, {40, 20}}, {}}};
  expect_turning_refused(apart, "transfers", "turn in place only");
}

TEST(TurningPlan, ACancelledPlanIsNone) {
  std::stop_source source;
  source.request_stop();
  Budget budget;
  budget.stop = source.get_token();
  const auto plan = find_cover_method("quickest")->plan(field(30, 20, 2.0, false), {}, budget);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, FaultCode::cancelled);
}

}  // namespace
}  // namespace outrider
